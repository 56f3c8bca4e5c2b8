#include "modules/brittle/register_module.h"

#include "engine/module_entry.h"
#include "modules/brittle/brittle.h"

#include <cmath>

namespace brittle {
namespace {

using engine::Result;

constexpr double kOnStep = 1e-6; // of a step: times are sums

std::string version() {
    return std::to_string(BRITTLE_VERSION_MAJOR) + "." + std::to_string(BRITTLE_VERSION_MINOR) + "." +
           std::to_string(BRITTLE_VERSION_PATCH);
}

struct SteppedWorld {
    std::unique_ptr<World> world;
    double dt = 0;  // s
    double due = 0; // s that it is behind
};

class BrittleModule : public engine::Module, public Worlds {
public:
    engine::ModuleInfo info() const override { return {"brittle", version()}; }
    std::span<const shaders::Module> kernels() const override { return shaders::all(); }
    void* service(std::string_view name) override { return name == kWorldsService ? static_cast<Worlds*>(this) : nullptr; }

    std::vector<engine::KernelLibrary*> libraries() override {
        std::vector<engine::KernelLibrary*> all;
        for (const SteppedWorld& stepped : worlds_)
            all.push_back(&stepped.world->kernels());
        return all;
    }

    Result<void> onKernelsChanged() override {
        for (const SteppedWorld& stepped : worlds_)
            if (auto recorded = stepped.world->kernelsChanged(); !recorded) return recorded;
        return {};
    }

    Result<void> onDevice(engine::Device& device) override {
        device_ = &device;
        return {};
    }

    Result<void> onFrame(engine::FrameContext& frame) override {
        for (SteppedWorld& stepped : worlds_) {
            stepped.due += frame.dt;
            const auto steps = static_cast<uint32_t>(std::floor(stepped.due / stepped.dt + kOnStep));
            stepped.due -= steps * stepped.dt;
            if (auto recorded = stepped.world->recordSteps(frame.commands.handle(), steps); !recorded) return recorded;
        }
        return {};
    }

    void onShutdown() override {
        worlds_.clear();
        device_ = nullptr;
    }

    Result<World*> add(const WorldContents& contents, const StepSettings& settings, const WorldBudget& budget) override {
        if (device_ == nullptr)
            return engine::Error{engine::ErrorCode::BadInput,
                                 "a world needs the module \"brittle\" to have started; start its registry first"};
        auto world = World::create(*device_, contents, settings, budget);
        if (!world) return world.error();
        worlds_.push_back({std::move(*world), settings.dt, 0});
        return worlds_.back().world.get();
    }

private:
    engine::Device* device_ = nullptr;
    std::vector<SteppedWorld> worlds_;
};

} // namespace

ENGINE_MODULE(makeBrittleModule, BrittleModule)

} // namespace brittle
