// A file that is there whole or not at all: written beside its place under another name and moved there at the end.
//
// The other name is NAME.part and the number of the process. A process that is killed leaves it. The next one that writes NAME
// removes it, unless a process of that number runs, or one of another machine or container holds the file's lock.
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
    OutputFile(std::filesystem::path path, std::filesystem::path temporary, int lock);
    void release(); // the lock

    std::filesystem::path path_, temporary_; // the latter empty once committed
    int lock_ = -1;                          // a file descriptor
};

} // namespace brittle
