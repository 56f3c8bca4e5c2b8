// Leaves nothing half written where a run is interrupted.
#pragma once

#include "modules/brittle/export/output_file.h"

#include <filesystem>
#include <functional>
#include <utility>
#include <vector>

namespace cli {

// From here on SIGINT, SIGTERM and SIGHUP remove what createOutput has begun and was not committed, and what folders are empty
// of those that OutputFolder has made, and end the process as they would have. To be called before any other thread is started.
void cleanUpWhenInterrupted();

// Has an interrupt call this as well, after those files are removed. It runs on a thread of its own.
void whenInterrupted(std::function<void()> action);

// OutputFile::create, for a file that an interrupt removes.
engine::Result<brittle::OutputFile> createOutput(const std::filesystem::path& path);

// A folder for output. Of those that had to be made for it the empty ones go with it.
class OutputFolder {
public:
    OutputFolder() = default;
    // Errors: BadInput, for what cannot be made.
    static engine::Result<OutputFolder> create(const std::filesystem::path& path);
    OutputFolder(OutputFolder&& other) noexcept : made_(std::exchange(other.made_, {})) {}
    OutputFolder& operator=(OutputFolder&& other) noexcept {
        std::swap(made_, other.made_);
        return *this;
    }
    ~OutputFolder();

private:
    std::vector<std::filesystem::path> made_; // the outermost first
};

} // namespace cli
