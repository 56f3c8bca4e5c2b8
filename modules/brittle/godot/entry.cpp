// Where the engine meets the plugin: it loads the library, calls its one exported function, and later lets the plugin announce
// its classes and withdraw them.
#include "modules/brittle/godot/interface/host.h"
#include "modules/brittle/godot/interface/messages.h"
#include "modules/brittle/godot/nodes/brittle_material.h"
#include "modules/brittle/godot/nodes/brittle_world.h"

#include <cstdio>
#include <deque>

namespace brittle_godot {
namespace {

std::deque<ClassRecord> classes; // stay where they are: the engine has their addresses

template <class Node>
void announce(const char* name, const char* parent) {
    ClassRecord& record =
        classes.emplace_back(name, parent, []() -> std::unique_ptr<Instance> { return std::make_unique<Node>(); });
    Node::describe(record);
    record.announce();
}

void initialize(void*, int32_t level) {
    if (level != kLevelScene) return;
    announce<MaterialResource>("BrittleMaterial", "Resource");
    announce<BodyNode>("BrittleBody3D", "MeshInstance3D");
    announce<WorldNode>("BrittleWorld3D", "Node3D");
}

void deinitialize(void*, int32_t level) {
    if (level != kLevelScene) return;
    for (; !classes.empty(); classes.pop_back())
        classes.back().withdraw();
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
