#include "engine/image_io.h"

#include <cstdio>
#include <filesystem>
#include <fstream>

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>

namespace engine {

namespace {

void append(void* stream, void* data, int size) {
    static_cast<std::string*>(stream)->append(static_cast<const char*>(data), static_cast<size_t>(size));
}

} // namespace

std::string encodePng(const Picture& picture) {
    std::string bytes;
    const int width = static_cast<int>(picture.width), height = static_cast<int>(picture.height);
    stbi_write_png_to_func(append, &bytes, width, height, 4, picture.pixels.data(), 4 * width);
    return bytes;
}

Result<void> writePng(const Picture& picture, const std::string& path) {
    const std::string bytes = encodePng(picture), unfinished = path + ".part";
    std::ofstream file(unfinished, std::ios::binary);
    if (!file) return Error{ErrorCode::BadInput, "cannot write " + path};
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    std::error_code failed;
    const bool is_written = !bytes.empty() && file.good();
    if (is_written) std::filesystem::rename(unfinished, path, failed);
    if (is_written && !failed) return {};
    std::filesystem::remove(unfinished, failed);
    return Error{ErrorCode::BadInput, "cannot write " + path + ": the disk is full or the folder is read-only"};
}

} // namespace engine
