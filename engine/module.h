// Modules: what a program is put together from. The engine knows them only by this interface, whether they are linked into the
// program or loaded from a file (module_file.h).
#pragma once

#include "engine/commands.h"
#include "engine/device.h"

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace engine {

struct FrameContext {
    Device& device;
    Commands& commands; // record here; the frame submits
    uint64_t index = 0; // of the frame, from 0
    double dt = 0;      // seconds that this frame moves on
    double time = 0;    // seconds at its beginning
};

struct ModuleInfo {
    std::string name;
    std::string version;
};

class Module {
public:
    virtual ~Module() = default;
    virtual ModuleInfo info() const = 0;
    // The table of the kernels that it brings along, and the names of those that it cannot do without; both are looked at
    // before anything is started.
    virtual std::span<const shaders::Module> kernels() const { return {}; }
    virtual std::vector<std::string_view> neededKernels() const { return {}; }
    // The libraries that its kernels run from, for whoever reloads them (reload/shader_reloader.h); it is told when they have
    // changed, between two frames. From onDevice to onShutdown.
    virtual std::vector<KernelLibrary*> libraries() { return {}; }
    virtual Result<void> onKernelsChanged() { return {}; }
    // An interface that it offers to those who know it by its name, as a pointer to what that name stands for; else nullptr.
    virtual void* service(std::string_view name) { return static_cast<void>(name), nullptr; }

    // The device is ready: make buffers and pipelines.
    virtual Result<void> onDevice(Device& device) = 0;
    // Record this frame's work. Never submit, never wait.
    virtual Result<void> onFrame(FrameContext& frame) = 0;
    // Give back all that came from the device; it is idle.
    virtual void onShutdown() = 0;
};

// Handed in where it is needed, there is no global one. Modules start in the order in which they were added and end in the
// opposite one.
class ModuleRegistry {
public:
    ModuleRegistry() = default;
    ~ModuleRegistry() { shutDown(); }
    ModuleRegistry(const ModuleRegistry&) = delete;
    ModuleRegistry& operator=(const ModuleRegistry&) = delete;

    // Refused: a name that is taken, or a registry that has started.
    Result<void> add(std::unique_ptr<Module> module);
    // The same of a module in a file. Errors: BadInput, those of loadModule too.
    Result<void> load(const std::filesystem::path& file);
    Module* find(std::string_view name) const;
    std::span<const std::unique_ptr<Module>> modules() const { return modules_; }

    // Where one fails to start, or lacks a kernel that it needs, those before it are shut down again. What a module throws is
    // an error of Internal, here and in frame().
    Result<void> start(Device& device);
    Result<void> frame(FrameContext& frame);
    void shutDown();

private:
    std::vector<std::unique_ptr<Module>> modules_;
    size_t started_ = 0;
    Device* device_ = nullptr;
};

} // namespace engine
