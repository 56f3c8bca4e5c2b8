#include "modules/brittle/export/output_file.h"

#include <fstream>
#include <unistd.h>
#include <utility>

namespace brittle {
namespace {

engine::Error cannotWrite(const std::filesystem::path& path, const std::string& why) {
    return {engine::ErrorCode::BadInput, path.string() + ": cannot be written (" + why + "); choose another place"};
}

} // namespace

OutputFile::OutputFile(std::filesystem::path path, std::filesystem::path temporary)
    : path_(std::move(path)), temporary_(std::move(temporary)) {}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)), temporary_(std::exchange(other.temporary_, {})) {}

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(temporary_, other.temporary_);
    return *this;
}

OutputFile::~OutputFile() {
    std::error_code ignored;
    if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
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
    temporary += ".part" + std::to_string(getpid());
    if (!std::ofstream(temporary, std::ios::binary)) return cannotWrite(path, "no such folder, or no permission");
    return OutputFile(place, temporary);
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
    return {};
}

} // namespace brittle
