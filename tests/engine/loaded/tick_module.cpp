#include "tests/engine/loaded/tick_module.h"

#include "engine/module_entry.h"

#include <cmath>

namespace shaders {
std::span<const Module> tickKernels();
}

namespace tick {
namespace {

using engine::Result;

class Tick : public engine::Module, public Clock {
public:
    engine::ModuleInfo info() const override { return {"tick", "1.0"}; }
    std::span<const shaders::Module> kernels() const override { return shaders::tickKernels(); }
    std::vector<std::string_view> neededKernels() const override { return {"tick"}; }
    std::vector<engine::KernelLibrary*> libraries() override { return {library_.get()}; }
    void* service(std::string_view name) override { return name == kClock ? static_cast<Clock*>(this) : nullptr; }

    Result<void> onDevice(engine::Device& device) override {
        device_ = &device;
        library_ = std::make_unique<engine::KernelLibrary>(device, shaders::tickKernels());
        const auto kernel = library_->get("tick");
        if (!kernel) return kernel.error();
        kernel_ = *kernel;
        auto made = engine::Buffer::create(device, 8, engine::BufferDomain::Device, 0, "ticks");
        if (!made) return made.error();
        ticks_ = std::move(*made);
        return {};
    }

    Result<void> onFrame(engine::FrameContext& frame) override {
        if (frame.index == 0) frame.commands.fill(ticks_, 0);
        frame.commands.beginLabel("tick");
        frame.commands.dispatch(*kernel_, 1, static_cast<uint32_t>(std::lround(1000 * frame.dt)), {ticks_});
        frame.commands.endLabel();
        return {};
    }

    void onShutdown() override {
        library_.reset();
        ticks_ = {};
    }

    Result<std::array<uint32_t, 2>> read() override {
        auto copy = engine::Buffer::create(*device_, 8, engine::BufferDomain::Readback, 0, "ticks read");
        if (!copy) return copy.error();
        engine::Commands commands(*device_);
        if (auto begun = commands.begin(); !begun) return begun.error();
        commands.copy(ticks_, *copy);
        if (auto done = commands.submitAndWait(); !done) return done.error();
        const auto* words = copy->mappedAs<uint32_t>();
        return std::array{words[0], words[1]};
    }

private:
    engine::Device* device_ = nullptr;
    std::unique_ptr<engine::KernelLibrary> library_;
    const engine::Kernel* kernel_ = nullptr;
    engine::Buffer ticks_;
};

} // namespace

ENGINE_MODULE(makeTick, Tick)

} // namespace tick
