// The folder that a check writes its results to.
#pragma once

#include "engine/result.h"

#include <filesystem>
#include <utility>

namespace device_check {

// Keeps other checks out of a folder while it lives, and while the process does. It leaves no file.
class FolderLock {
public:
    explicit FolderLock(int file) : file_(file) {}
    FolderLock(FolderLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;
    ~FolderLock();

private:
    int file_;
};

// Makes the folder if it is not there. Errors: BadInput if it cannot be made, or if another check writes to it.
engine::Result<FolderLock> lockFolder(const std::filesystem::path& folder);

// Makes a new folder in `folder`, which must be locked, and removes those that checks have left there that were killed.
// Errors: BadInput if it cannot be made.
engine::Result<std::filesystem::path> makeScratch(const std::filesystem::path& folder);

} // namespace device_check
