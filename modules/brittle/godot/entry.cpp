// Where the engine meets the plugin: it loads the library, calls its one exported function, and later lets the plugin announce
// its classes and withdraw them.
#include "modules/brittle/godot/interface/host.h"
#include "modules/brittle/godot/interface/messages.h"
#include "modules/brittle/godot/nodes/brittle_material.h"
#include "modules/brittle/godot/nodes/brittle_world.h"

#include <array>
#include <cstdio>

namespace brittle_godot {
namespace {

using Classes = std::array<ClassRecord, 3>;
std::unique_ptr<Classes> classes;

template <class Node>
std::unique_ptr<Instance> make() {
    return std::make_unique<Node>();
}

void initialize(void*, int32_t level) {
    if (level != kLevelScene) return;
    classes.reset(new Classes{ClassRecord("BrittleMaterial", "Resource", make<MaterialResource>),
                              ClassRecord("BrittleBody3D", "MeshInstance3D", make<BodyNode>),
                              ClassRecord("BrittleWorld3D", "Node3D", make<WorldNode>)});
    MaterialResource::describe((*classes)[0]);
    BodyNode::describe((*classes)[1]);
    WorldNode::describe((*classes)[2]);
    for (ClassRecord& record : *classes)
        record.announce();
}

void deinitialize(void*, int32_t level) {
    if (level != kLevelScene || classes == nullptr) return;
    for (auto record = classes->rbegin(); record != classes->rend(); ++record)
        record->withdraw();
    classes.reset();
}

} // namespace
} // namespace brittle_godot

// 0 refuses the engine, which then says that the extension cannot be used.
extern "C" __attribute__((visibility("default"))) uint8_t brittle_godot_init(brittle_godot::GetProcAddress get_proc_address,
                                                                             void* library,
                                                                             brittle_godot::Initialization* initialization) {
    using namespace brittle_godot;
    std::string missing;
    if (!meetHost(get_proc_address, library, missing)) {
        std::fprintf(stderr, "Brittle needs Godot 4.4 or newer; this one has not: %s\n", missing.c_str());
        return 0;
    }
    initialization->first_level = kLevelScene;
    initialization->initialize = brittle_godot::initialize;
    initialization->deinitialize = brittle_godot::deinitialize;
    return 1;
}
