// What a whole process costs that breaks a small model: with nothing in the driver's cache, and with all of it.
#include "tools/bench/bench.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace bench {
namespace {

namespace fs = std::filesystem;

class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string name = (fs::temp_directory_path() / "brittle_bench_XXXXXX").string();
        if (mkdtemp(name.data()) != nullptr) path_ = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        if (!path_.empty()) fs::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

// Milliseconds; nothing where it failed. Mesa keeps its cache in `cache`; other drivers keep theirs where they always do.
std::optional<double> runOnce(const fs::path& program, const fs::path& cache, const std::string& device) {
    const std::string command = "MESA_SHADER_CACHE_DIR='" + cache.string() + "' BRITTLE_DEVICE='" + device + "' '" +
                                program.string() + "' shatter builtin:icosphere:3 --sites 10 -o '" +
                                (cache / "out.glb").string() + "' >/dev/null 2>&1";
    const auto begin = std::chrono::steady_clock::now();
    if (std::system(command.c_str()) != 0) return std::nullopt; // NOLINT(cert-env33-c): our own program, our own arguments
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

} // namespace

engine::Result<StartupRow> benchStartup(engine::Device& device, const BenchOptions& options, const Progress& progress) {
    std::error_code unreadable;
    const fs::path self = fs::read_symlink("/proc/self/exe", unreadable);
    std::vector<double> cold, warm;
    for (uint32_t round = 0; round < options.startup_rounds; ++round) {
        progress("start of a process with an empty cache, " + std::to_string(round + 1) + " of " +
                 std::to_string(options.startup_rounds));
        const TemporaryFolder folder;
        const auto first = runOnce(self, folder.path(), device.name()), second = runOnce(self, folder.path(), device.name());
        if (!first || !second)
            return engine::Error{engine::ErrorCode::Internal, "the program could not run itself; try `brittle shatter`"};
        cold.push_back(*first);
        warm.push_back(*second);
    }
    return StartupRow{median(cold), median(warm)};
}

} // namespace bench
