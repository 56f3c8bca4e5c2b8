// A file that is there whole or not at all: written beside its place under another name and moved there at the end.
#pragma once

#include "engine/result.h"

#include <filesystem>
#include <string_view>

namespace brittle {

class OutputFile {
public:
    // Fails at once, before any work was done, where nothing can be written.
    static engine::Result<OutputFile> create(const std::filesystem::path& path);
    OutputFile(OutputFile&& other) noexcept;
    OutputFile& operator=(OutputFile&& other) noexcept;
    ~OutputFile(); // removes what was not committed

    const std::filesystem::path& temporaryPath() const { return temporary_; } // for whoever writes it
    engine::Result<void> write(std::string_view bytes);
    engine::Result<void> commit();

private:
    OutputFile(std::filesystem::path path, std::filesystem::path temporary);

    std::filesystem::path path_, temporary_; // the latter empty once committed
};

} // namespace brittle
