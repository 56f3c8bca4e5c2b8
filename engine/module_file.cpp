#include "engine/module_file.h"

#include "engine/module_entry.h"

#include <dlfcn.h>
#include <exception>
#include <fstream>

namespace engine {

namespace {

namespace fs = std::filesystem;

struct Unload {
    void operator()(void* library) const { dlclose(library); }
};
using Library = std::unique_ptr<void, Unload>;

// Passes everything on to a module whose code goes away after it.
class LoadedModule : public Module {
public:
    LoadedModule(Library library, std::unique_ptr<Module> module) : library_(std::move(library)), module_(std::move(module)) {}

    ModuleInfo info() const override { return module_->info(); }
    std::span<const shaders::Module> kernels() const override { return module_->kernels(); }
    std::vector<std::string_view> neededKernels() const override { return module_->neededKernels(); }
    std::vector<KernelLibrary*> libraries() override { return module_->libraries(); }
    Result<void> onKernelsChanged() override { return module_->onKernelsChanged(); }
    void* service(std::string_view name) override { return module_->service(name); }
    Result<void> onDevice(Device& device) override { return module_->onDevice(device); }
    Result<void> onFrame(FrameContext& frame) override { return module_->onFrame(frame); }
    void onShutdown() override { module_->onShutdown(); }

private:
    Library library_;
    std::unique_ptr<Module> module_;
};

Error refused(const fs::path& file, const std::string& why) { return {ErrorCode::BadInput, file.string() + ": " + why}; }

Result<void> checkFile(const fs::path& file) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return refused(file, "there is no such file");
    std::array<char, 4> magic = {};
    std::ifstream(file, std::ios::binary).read(magic.data(), magic.size());
    if (magic != std::array<char, 4>{'\x7f', 'E', 'L', 'F'})
        return refused(file, "is no shared library; give the file that a module was built into");
    return {};
}

Result<const ModuleEntry*> entryOf(void* library, const fs::path& file) {
    const auto* entry = static_cast<const ModuleEntry*>(dlsym(library, kModuleEntryName));
    if (entry == nullptr)
        return refused(file, std::string("holds no module of this engine: it has no object ") + kModuleEntryName +
                                 " (ENGINE_MODULE in module_entry.h)");
    if (entry->interface != kModuleInterface)
        return refused(file, "is for interface " + std::to_string(entry->interface) + " of the engine, this one has " +
                                 std::to_string(kModuleInterface) + "; build it against this engine");
    if (entry->size != sizeof(ModuleEntry) || !(entry->build == thisBuild()))
        return refused(file,
                       "was built by another compiler or against other headers than this program; build it anew, by g++ " +
                           std::string(thisBuild().compiler.data()));
    if (entry->create == nullptr) return refused(file, "makes no module: its engine_module has no function for that");
    return entry;
}

Result<std::unique_ptr<Module>> make(const ModuleEntry& entry, const fs::path& file) {
    try {
        if (std::unique_ptr<Module> module{entry.create()}) return module;
        return refused(file, "made no module");
    } catch (const std::exception& thrown) {
        return refused(file, std::string("threw while it made its module: ") + thrown.what());
    }
}

} // namespace

Result<std::unique_ptr<Module>> loadModule(const fs::path& file) {
    if (auto sound = checkFile(file); !sound) return sound.error();
    std::error_code error;
    // With a folder in its name, or the loader would look for it elsewhere.
    const fs::path place = fs::absolute(file, error);
    Library library(dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL));
    if (library == nullptr) {
        const char* why = dlerror();
        return refused(file, std::string("cannot be loaded: ") + (why != nullptr ? why : "the system does not say why"));
    }
    const auto entry = entryOf(library.get(), file);
    if (!entry) return entry.error();
    auto module = make(**entry, file);
    if (!module) return module;
    return std::unique_ptr<Module>(std::make_unique<LoadedModule>(std::move(library), std::move(*module)));
}

} // namespace engine
