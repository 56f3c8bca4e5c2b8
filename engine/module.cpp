#include "engine/module.h"

namespace engine {

namespace {

Error named(const Module& module, const Error& error) {
    return {error.code, "module \"" + module.info().name + "\": " + error.message};
}

} // namespace

Result<void> ModuleRegistry::add(std::unique_ptr<Module> module) {
    ENGINE_ASSERT(module != nullptr);
    const std::string name = module->info().name;
    if (device_ != nullptr) return Error{ErrorCode::BadInput, "module \"" + name + "\" comes after the start"};
    if (find(name) != nullptr) return Error{ErrorCode::BadInput, "two modules are named \"" + name + "\""};
    modules_.push_back(std::move(module));
    return {};
}

Module* ModuleRegistry::find(std::string_view name) const {
    for (const auto& module : modules_) {
        if (module->info().name == name) return module.get();
    }
    return nullptr;
}

Result<void> ModuleRegistry::start(Device& device) {
    ENGINE_ASSERT(device_ == nullptr);
    device_ = &device;
    for (const auto& module : modules_) {
        if (auto begun = module->onDevice(device); !begun) {
            const Error error = named(*module, begun.error());
            shutDown();
            return error;
        }
        ++started_;
    }
    return {};
}

Result<void> ModuleRegistry::frame(FrameContext& frame) {
    for (const auto& module : modules_) {
        if (auto recorded = module->onFrame(frame); !recorded) return named(*module, recorded.error());
    }
    return {};
}

void ModuleRegistry::shutDown() {
    if (device_ == nullptr) return;
    device_->waitIdle();
    while (started_ > 0)
        modules_[--started_]->onShutdown();
    device_ = nullptr;
}

} // namespace engine
