// What a file with a module in it shows to the engine: one object, named engine_module.
//
//     class Rain : public engine::Module { ... };
//     ENGINE_MODULE(makeRain, Rain)
//
// defines std::unique_ptr<engine::Module> makeRain(), for programs that link it, and, where ENGINE_MODULE_SHARED is defined,
// the object for programs that load it. engine_module() of engine_module.cmake builds both from the same sources.
//
// Modules and engines talk in C++, so a file has to be built by the same compiler against the same headers: it says by what it
// was built, and any other is refused.
#pragma once

#include "engine/frame.h"
#include "engine/module.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace engine {

constexpr uint32_t kModuleInterface = 1; // counts changes of Module and of what it is handed

// What else has to agree: sizes of what crosses the border give away headers that differ.
struct ModuleBuild {
    std::array<char, 24> compiler = {}; // its version
    std::array<uint32_t, 8> sizes = {};
    bool operator==(const ModuleBuild&) const = default;
};

constexpr ModuleBuild thisBuild() {
    ModuleBuild build;
    constexpr const char* kCompiler = __VERSION__;
    for (size_t k = 0; k + 1 < build.compiler.size() && kCompiler[k] != '\0'; ++k)
        build.compiler[k] = kCompiler[k];
    build.sizes = {sizeof(Module),   sizeof(ModuleInfo), sizeof(FrameContext),  sizeof(Device),
                   sizeof(Commands), sizeof(Kernel),     sizeof(KernelLibrary), sizeof(shaders::Module)};
    return build;
}

struct ModuleEntry {
    uint32_t interface = kModuleInterface; // first, so that it can be read whatever follows
    uint32_t size = sizeof(ModuleEntry);
    ModuleBuild build = thisBuild();
    Module* (*create)() = nullptr; // a new one; its owner deletes it
};

constexpr const char* kModuleEntryName = "engine_module";

} // namespace engine

#ifdef ENGINE_MODULE_SHARED
#define ENGINE_MODULE_ENTRY(Type)                                                                                              \
    extern "C" __attribute__((visibility("default"))) const engine::ModuleEntry engine_module;                                 \
    const engine::ModuleEntry engine_module = {.create = []() -> engine::Module* { return new Type; }};
#else
#define ENGINE_MODULE_ENTRY(Type)
#endif

#define ENGINE_MODULE(make, Type)                                                                                              \
    std::unique_ptr<engine::Module> make();                                                                                    \
    std::unique_ptr<engine::Module> make() { return std::make_unique<Type>(); }                                                \
    ENGINE_MODULE_ENTRY(Type)
