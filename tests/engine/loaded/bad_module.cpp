// Files that are wrong in one way each, by BAD_*.
#include "engine/module_entry.h"

namespace {

class Lacking : public engine::Module {
public:
    engine::ModuleInfo info() const override { return {"lacking", "1.0"}; }
    std::vector<std::string_view> neededKernels() const override { return {"absent_kernel"}; }
    engine::Result<void> onDevice(engine::Device&) override { return {}; }
    engine::Result<void> onFrame(engine::FrameContext&) override { throw std::runtime_error("thrown in a frame"); }
    void onShutdown() override {}
};

class Throwing : public Lacking {
public:
    std::vector<std::string_view> neededKernels() const override { return {}; }
};

template <class Type>
engine::Module* make() {
    return new Type;
}
[[maybe_unused]] engine::Module* makeNothing() { return nullptr; }

[[maybe_unused]] constexpr engine::ModuleBuild otherBuild() {
    engine::ModuleBuild build = engine::thisBuild();
    build.sizes[0] += 8;
    return build;
}

} // namespace

#if defined(BAD_NAME)
#define engine_module another_object
#endif

extern "C" __attribute__((visibility("default"))) const engine::ModuleEntry engine_module;
const engine::ModuleEntry engine_module = {
#if defined(BAD_INTERFACE)
    .interface = 99,
#endif
#if defined(BAD_BUILD)
    .build = otherBuild(),
#endif
#if defined(BAD_CREATE)
    .create = makeNothing,
#elif defined(BAD_KERNELS)
    .create = make<Lacking>,
#else
    .create = make<Throwing>,
#endif
};
