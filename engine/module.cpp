#include "engine/module.h"

#include "engine/module_file.h"
#include "engine/reflection.h"

#include <algorithm>
#include <exception>

namespace engine {

namespace {

Error named(const Module& module, const Error& error) {
    return {error.code, "module \"" + module.info().name + "\": " + error.message};
}

// What is thrown in somebody else's code does not end the program.
template <class Work>
Result<void> guarded(const Module& module, Work&& work) {
    try {
        if (auto done = work(); !done) return named(module, done.error());
        return {};
    } catch (const std::exception& thrown) {
        return named(module, {ErrorCode::Internal, std::string("threw: ") + thrown.what()});
    }
}

Result<void> checkKernels(const Module& module) {
    const std::span<const shaders::Module> kernels = module.kernels();
    for (const std::string_view needed : module.neededKernels())
        if (std::ranges::find(kernels, needed, &shaders::Module::name) == kernels.end())
            return Error{ErrorCode::BadInput,
                         "has no kernel \"" + std::string(needed) + "\", which it needs; build it with its table of kernels"};
    for (const shaders::Module& kernel : kernels)
        if (auto readable = reflect(kernel.words); !readable)
            return Error{ErrorCode::BadInput, "kernel \"" + std::string(kernel.name) + "\": " + readable.error().message};
    return {};
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

Result<void> ModuleRegistry::load(const std::filesystem::path& file) {
    auto module = loadModule(file);
    if (!module) return module.error();
    if (auto added = add(std::move(*module)); !added)
        return Error{added.error().code, file.string() + ": " + added.error().message};
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
        const auto begin = [&]() -> Result<void> {
            if (auto checked = checkKernels(*module); !checked) return checked;
            return module->onDevice(device);
        };
        if (auto begun = guarded(*module, begin); !begun) {
            shutDown();
            return begun;
        }
        ++started_;
    }
    return {};
}

Result<void> ModuleRegistry::frame(FrameContext& frame) {
    for (const auto& module : modules_) {
        if (auto recorded = guarded(*module, [&] { return module->onFrame(frame); }); !recorded) return recorded;
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
