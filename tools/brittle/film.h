// A film, made by ffmpeg from pictures that it is given one by one.
#pragma once

#include "engine/image_io.h"

#include <memory>
#include <string>

namespace cli {

class Film {
public:
    // Errors: BadInput, where there is no ffmpeg to run; it names the package.
    static engine::Result<void> isPossible();
    // Pictures of this size, so many a second, into an MP4 file of that name, whatever its ending. One that ends before
    // `finish` leaves half a file there.
    static engine::Result<std::unique_ptr<Film>> start(const std::string& path, uint32_t width, uint32_t height, double fps);
    virtual ~Film() = default;

    // Errors of both: BadInput, with what ffmpeg said, where it could not go on.
    virtual engine::Result<void> add(const engine::Picture& picture) = 0;
    virtual engine::Result<void> finish() = 0;
};

} // namespace cli
