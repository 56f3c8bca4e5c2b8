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
    static_cast<std::ofstream*>(stream)->write(static_cast<const char*>(data), size);
}

} // namespace

Result<void> writePng(const Picture& picture, const std::string& path) {
    const std::string unfinished = path + ".part";
    std::ofstream file(unfinished, std::ios::binary);
    if (!file) return Error{ErrorCode::BadInput, "cannot write " + path};
    const int width = static_cast<int>(picture.width), height = static_cast<int>(picture.height);
    const int written = stbi_write_png_to_func(append, &file, width, height, 4, picture.pixels.data(), 4 * width);
    file.close();
    std::error_code failed;
    if (written != 0 && file) std::filesystem::rename(unfinished, path, failed);
    if (written != 0 && file && !failed) return {};
    std::filesystem::remove(unfinished, failed);
    return Error{ErrorCode::BadInput, "cannot write " + path + ": the disk is full or the folder is read-only"};
}

} // namespace engine
