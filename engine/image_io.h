// Pictures as files.
#pragma once

#include "engine/result.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace engine {

// Rows from the top, four bytes a pixel: red, green, blue, alpha, in sRGB.
struct Picture {
    uint32_t width = 0, height = 0;
    std::vector<uint8_t> pixels;

    std::array<uint8_t, 4> at(uint32_t x, uint32_t y) const {
        const uint8_t* p = &pixels[4 * (size_t(y) * width + x)];
        return {p[0], p[1], p[2], p[3]};
    }
};

// As a PNG file.
std::string encodePng(const Picture& picture);
// Written beside the target and moved into its place, so that no half picture is ever seen.
Result<void> writePng(const Picture& picture, const std::string& path);

} // namespace engine
