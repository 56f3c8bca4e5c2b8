// What a whole process costs that breaks a small model: with nothing in the driver's cache, and with all of it.
#include "tools/bench/bench.h"
#include "tools/device_check/cached_start.h"

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

constexpr std::chrono::minutes kLongest{10};

// Milliseconds; nothing if the program failed.
std::optional<double> runOnce(const std::string& program, const fs::path& cache, const std::string& device) {
    const device_check::ChildCommand command = {
        .words = {program, "shatter", "builtin:icosphere:3", "--sites", "10", "-o", (cache / "out.glb").string()},
        .environment = {"BRITTLE_DEVICE=" + device},
        .until = device_check::Clock::now() + kLongest};
    const device_check::ChildEnd end = device_check::runWithCache(command, cache);
    if (!end.isGood()) return std::nullopt;
    return 1000 * end.seconds;
}

} // namespace

engine::Result<StartupRow> benchStartup(engine::Device& device, const BenchOptions& options, const Progress& progress) {
    const std::string self = device_check::ownPath();
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
