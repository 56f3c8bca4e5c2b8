#include "tools/device_check/output_folder.h"

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <sys/file.h>
#include <unistd.h>

namespace device_check {
namespace {

namespace fs = std::filesystem;

// Tells a folder of makeScratch from one with a similar name.
constexpr const char* kMark = "made_by_check_device";

engine::Error refused(const fs::path& folder, const std::string& why) {
    return {engine::ErrorCode::BadInput, folder.string() + ": " + why + "; give another folder with -o"};
}

void removeLeftScratch(const fs::path& folder) {
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
        if (entry.path().filename().string().starts_with("scratch-") && fs::exists(entry.path() / kMark, ignored))
            fs::remove_all(entry.path(), ignored);
}

} // namespace

FolderLock::~FolderLock() {
    if (file_ >= 0) close(file_);
}

// A file system that cannot lock, as some network disks, is used without.
engine::Result<FolderLock> lockFolder(const fs::path& folder) {
    std::error_code failed;
    fs::create_directories(folder, failed);
    const int file = failed ? -1 : open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file < 0) return refused(folder, "cannot be written to");
    FolderLock lock(file);
    if (flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        return refused(folder, "another check writes its results there now");
    return lock;
}

engine::Result<fs::path> makeScratch(const fs::path& folder) {
    removeLeftScratch(folder);
    std::string name = (folder / "scratch-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) return refused(folder, "cannot be written to");
    std::ofstream(fs::path(name) / kMark) << "brittle check-device removes this folder\n";
    return fs::path(name);
}

} // namespace device_check
