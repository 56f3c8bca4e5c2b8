#include "modules/brittle/export/output_file.h"

#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <sys/file.h>
#include <unistd.h>
#include <utility>

namespace brittle {
namespace {

engine::Error cannotWrite(const std::filesystem::path& path, const std::string& why) {
    return {engine::ErrorCode::BadInput, path.string() + ": cannot be written (" + why + "); choose another place"};
}

constexpr std::string_view kPartial = ".part"; // and the number of the process

// The process that writes a partial file of this name, "NAME.part123". 0 if it is no such name.
pid_t writerOf(std::string_view file, std::string_view name) {
    if (!file.starts_with(name) || !file.substr(name.size()).starts_with(kPartial)) return 0;
    const std::string_view number = file.substr(name.size() + kPartial.size());
    pid_t writer = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), writer);
    return error == std::errc() && end == number.data() + number.size() && writer > 0 ? writer : 0;
}

bool isLocked(const std::filesystem::path& file) {
    const int opened = open(file.c_str(), O_RDWR | O_CLOEXEC);
    if (opened < 0) return true; // not ours to remove
    const bool locked = flock(opened, LOCK_EX | LOCK_NB) != 0;
    close(opened);
    return locked;
}

// A process writes its file within a minute of making it, or holds a lock on it. So the number of a file that has neither may
// be that of another process by now.
bool isAbandoned(const std::filesystem::path& file) {
    std::error_code error;
    const auto written = std::filesystem::last_write_time(file, error);
    return !error && std::filesystem::file_time_type::clock::now() - written > std::chrono::minutes(1);
}

// Removes what killed processes left beside `place`.
void removeStale(const std::filesystem::path& place) {
    std::error_code ignored;
    const std::filesystem::path folder = place.has_parent_path() ? place.parent_path() : ".";
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
        const pid_t writer = writerOf(entry.path().filename().native(), place.filename().native());
        if (writer == 0) continue;
        const bool has_ended = kill(writer, 0) != 0 && errno == ESRCH;
        if ((!has_ended && !isAbandoned(entry.path())) || isLocked(entry.path())) continue;
        std::filesystem::remove(entry.path(), ignored);
    }
}

} // namespace

OutputFile::OutputFile(std::filesystem::path path, std::filesystem::path temporary, int lock)
    : path_(std::move(path)), temporary_(std::move(temporary)), lock_(lock) {}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)), temporary_(std::exchange(other.temporary_, {})), lock_(std::exchange(other.lock_, -1)) {}

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(temporary_, other.temporary_);
    std::swap(lock_, other.lock_);
    return *this;
}

OutputFile::~OutputFile() {
    std::error_code ignored;
    if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
    release();
}

void OutputFile::release() {
    if (lock_ >= 0) close(lock_);
    lock_ = -1;
}

engine::Result<OutputFile> OutputFile::create(const std::filesystem::path& path) {
    std::error_code error;
    if (!path.has_filename()) return cannotWrite(path, "it has no name");
    if (std::filesystem::is_directory(path, error)) return cannotWrite(path, "it is a folder");
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
        return cannotWrite(path, "it is a device, a pipe or the like, no file");
    // The file that a link leads to is replaced, not the link.
    const std::filesystem::path place = std::filesystem::exists(status) ? std::filesystem::canonical(path, error) : path;
    std::filesystem::path temporary = place;
    temporary += std::string(kPartial) + std::to_string(getpid());
    removeStale(place);
    const int lock = open(temporary.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (lock < 0) return cannotWrite(path, "no such folder, or no permission");
    (void)flock(lock, LOCK_SH | LOCK_NB); // some file systems have no locks; then the number of the process decides
    return OutputFile(place, temporary, lock);
}

engine::Result<void> OutputFile::write(std::string_view bytes) {
    std::ofstream file(temporary_, std::ios::binary | std::ios::trunc);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (!file) return cannotWrite(path_, "the disk may be full");
    return {};
}

engine::Result<void> OutputFile::commit() {
    std::error_code error;
    std::filesystem::rename(temporary_, path_, error);
    if (error) return cannotWrite(path_, error.message());
    temporary_.clear();
    release();
    return {};
}

} // namespace brittle
