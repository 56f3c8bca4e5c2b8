// Compute pipelines by name, made when first asked for, with everything about them read from their SPIR-V.
#pragma once

#include "engine/device_features.h"
#include "engine/pipeline.h"
#include "engine/reflection.h"
#include "shaders-spirv/embedded.h"

#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace engine {

// The most buffers that one kernel may bind; every device is asked for 16, those with more may use them.
constexpr uint32_t kMaxBindings = 32;

struct Kernel {
    std::string name;
    Reflection reflection; // local_size as it was specialized
    std::shared_ptr<const Pipeline> pipeline;

    std::vector<SpecConstant> constants; // that it was specialized with

    uint32_t bufferCount() const { return static_cast<uint32_t>(reflection.bindings.size()); }
};

struct KernelRequest {
    std::string_view name;
    std::vector<uint32_t> spec; // spec[i] sets constant_id i
};

using KernelWords = std::shared_ptr<const std::vector<uint32_t>>;

// Another version of a kernel with all that a library needs to run it; made by KernelLibrary::prepare.
struct KernelReplacement {
    std::string name;
    KernelWords words;
    std::map<std::vector<uint32_t>, std::shared_ptr<const Pipeline>> pipelines; // by what they are specialized with
};

class KernelLibrary {
public:
    // `common` holds for every kernel that declares a constant of that id: what all of them must agree on, such as the size
    // of their workgroups.
    explicit KernelLibrary(Device& device, std::span<const shaders::Module> modules = shaders::all(),
                           std::vector<SpecConstant> common = {});
    ~KernelLibrary();
    KernelLibrary(const KernelLibrary&) = delete;
    KernelLibrary& operator=(const KernelLibrary&) = delete;

    // Stays valid as long as the library. Safe from any thread.
    Result<const Kernel*> get(std::string_view name, std::span<const uint32_t> spec = {});
    Result<const Kernel*> get(std::string_view name, std::initializer_list<uint32_t> spec) {
        return get(name, std::span(spec.begin(), spec.size()));
    }
    // Makes many side by side, on all cores.
    Result<void> warm(std::span<const KernelRequest> requests);

    // Another version of a kernel, in every specialization that was asked for so far; nothing changes yet. Safe from any
    // thread. Errors: BadInput where its interface is another one (kernel_interface.h), Internal for no such kernel, Device.
    Result<KernelReplacement> prepare(std::string_view name, KernelWords words);
    // From now on these kernels are the other version, all of them or, after an error, none: pointers to them stay valid,
    // recordings that exist go on with what they were recorded with. Not while anybody records with them. Errors: Device.
    Result<void> adopt(std::span<KernelReplacement> replacements);
    // Whether it was asked for, and with which constants.
    bool has(std::string_view name) const;
    // Whether get() would find the pipeline among those that the libraries of its device share.
    bool isShared(std::string_view name) const;
    std::vector<std::vector<SpecConstant>> specializationsOf(std::string_view name) const;

    std::span<const shaders::Module> modules() const { return modules_; }
    const OptionalFeatures& deviceFeatures() const;
    const std::vector<SpecConstant>& common() const { return common_; }
    uint32_t kernelCount() const;
    std::vector<std::string> kernelNames() const; // of those made so far, in order, each once
    // All made so far, the first first, in each specialization. Names stay valid as long as the library.
    std::vector<KernelRequest> requests() const;
    double creationMs() const; // in the driver, added up over all pipelines made here, also those made at the same time

private:
    using Key = std::pair<std::string, std::vector<uint32_t>>;
    // The words of a kernel, those of a replacement for as long as they are looked at.
    struct Code {
        std::span<const uint32_t> words;
        KernelWords keeper;
    };
    Result<std::unique_ptr<Kernel>> make(std::string_view name, std::span<const uint32_t> spec, const Code& code);
    Result<Code> codeOf(std::string_view name) const;
    Code latestCode(std::string_view name) const; // with the lock held; of no words for no such kernel
    std::vector<std::pair<Key, const Kernel*>> kernelsNamed(std::string_view name) const;
    Result<void> complete(KernelReplacement& replacement);
    bool covers(const KernelReplacement& replacement) const; // with the lock held
    void install(const KernelReplacement& replacement);      // likewise
    std::vector<SpecConstant> constantsOf(const Reflection& reflection, std::span<const uint32_t> spec) const;
    Result<std::shared_ptr<const Pipeline>> makePipeline(const Kernel& kernel, std::span<const uint32_t> words);

    Device& device_;
    std::span<const shaders::Module> modules_;
    std::vector<SpecConstant> common_;
    mutable std::mutex mutex_;
    std::map<Key, std::unique_ptr<Kernel>> kernels_;
    std::vector<const Key*> order_;                            // of those, the first first
    std::map<std::string, KernelWords, std::less<>> replaced_; // words in place of those of `modules_`
    double creation_ms_ = 0;
};

} // namespace engine
