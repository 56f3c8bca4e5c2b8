#include "engine/reload/kernel_check.h"

#include "engine/kernel_storage.h"
#include "engine/reload/checking_process.h"
#include "engine/reload/declarations.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <sstream>
#include <thread>

namespace engine {

namespace fs = std::filesystem;

namespace {

// Errors where the interface is not the host's.
std::vector<Diagnostic> compare(const shaders::Module& host, std::span<const uint32_t> words, const KernelSource& source,
                                const std::vector<fs::path>& include_folders) {
    const auto before = reflect(host.words), now = reflect(words);
    if (!before || !now) return {{Severity::Error, source.file.string(), 0, 0, (before ? now : before).error().message}};
    const auto changes = interfaceChanges(*before, *now);
    return changes.empty() ? std::vector<Diagnostic>() : placeChanges(changes, source, include_folders);
}

void checkPart(const KernelStorage::Part& part, uint64_t most, const char* where, const KernelSource& source,
               std::vector<Diagnostic>& errors) {
    if (part.bytes <= most) return;
    const std::string name = part.largest.empty() ? "one variable" : "\"" + part.largest + "\"";
    errors.push_back({Severity::Error, source.file.string(), 0, 0,
                      "kernel \"" + source.name + "\": keeps " + std::to_string(part.bytes) + " bytes " + where + ", " + name +
                          " alone " + std::to_string(part.largest_bytes) + "; the most is " + std::to_string(most)});
}

std::vector<Diagnostic> checkStorage(std::span<const uint32_t> words, const KernelSource& source, const StorageLimits& limits) {
    const KernelStorage storage = storageOf(words, {});
    std::vector<Diagnostic> errors;
    checkPart(storage.shared, limits.shared_bytes, "in memory that its groups share", source, errors);
    checkPart(storage.lane, limits.lane_bytes, "for every lane", source, errors);
    return errors;
}

bool isKernel(const fs::path& file) {
    const fs::path extension = file.extension();
    return extension == ".comp" || extension == ".vert" || extension == ".frag";
}

std::vector<fs::path> kernelFilesIn(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
        if (isKernel(entry->path()) && entry->is_regular_file(error)) files.push_back(entry->path().lexically_normal());
    std::ranges::sort(files);
    return files;
}

} // namespace

KernelSource sourceOf(const shaders::Module& module, const fs::path& folder) {
    KernelSource source = {std::string(module.name), (folder / module.file).lexically_normal(), {}};
    std::istringstream defines{std::string(module.defines)};
    for (std::string define; defines >> define;)
        source.defines.push_back(define);
    return source;
}

CheckedKernel checkKernel(const KernelSource& source, const shaders::Module* host, const std::vector<fs::path>& include_folders,
                          const StorageLimits& limits) {
    const auto start = std::chrono::steady_clock::now();
    CompiledKernel compiled = compileGlsl(source, include_folders);
    CheckedKernel checked = {nullptr, std::move(compiled.diagnostics), std::move(compiled.files)};
    std::vector<Diagnostic> errors;
    if (compiled.good()) errors = checkStorage(compiled.words, source, limits);
    if (compiled.good() && errors.empty() && host != nullptr) errors = compare(*host, compiled.words, source, include_folders);
    checked.diagnostics.insert(checked.diagnostics.end(), errors.begin(), errors.end());
    if (compiled.good() && errors.empty())
        checked.words = std::make_shared<const std::vector<uint32_t>>(std::move(compiled.words));
    checked.ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return checked;
}

std::vector<FolderKernel> kernelsIn(const fs::path& folder, std::span<const shaders::Module> modules) {
    std::vector<FolderKernel> kernels;
    std::set<fs::path> named;
    std::error_code error;
    bool is_ours = false;
    for (const shaders::Module& module : modules) {
        kernels.push_back({sourceOf(module, folder), &module});
        named.insert(kernels.back().source.file);
        is_ours = is_ours || fs::exists(kernels.back().source.file, error);
    }
    if (!is_ours) kernels.clear();
    for (const fs::path& file : kernelFilesIn(folder))
        if (!named.contains(file)) kernels.push_back({{file.stem().string(), file, {}}, nullptr});
    return kernels;
}

std::vector<CheckedKernel> checkKernels(const std::vector<FolderKernel>& kernels, const std::vector<fs::path>& include_folders,
                                        const std::function<void(size_t)>& progress) {
    std::vector<CheckedKernel> checked(kernels.size());
    std::atomic<size_t> next = 0;
    std::mutex mutex;
    size_t done = 0;
    const auto work = [&] {
        CheckingProcess process;
        for (size_t k = next++; k < kernels.size(); k = next++) {
            checked[k] = process.check(kernels[k].source, kernels[k].host, include_folders);
            const std::lock_guard lock(mutex);
            if (progress) progress(++done);
        }
    };
    std::vector<std::jthread> threads;
    for (size_t k = 1; k < std::min<size_t>(std::max(1u, std::thread::hardware_concurrency()), kernels.size()); ++k)
        threads.emplace_back(work);
    work();
    threads.clear();
    return checked;
}

} // namespace engine
