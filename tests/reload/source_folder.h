// Tests that write sources and save them as editors do.
#pragma once

#include "tests/support/folder_test.h"

#include <fstream>
#include <string>

namespace reload_test {

namespace fs = std::filesystem;

inline void writeFile(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
}

// Into a file next to it, which is then given its name.
inline void writeAtomically(const fs::path& file, const std::string& text) {
    const fs::path fresh = file.string() + ".new";
    writeFile(fresh, text);
    fs::rename(fresh, file);
}

inline std::string readFile(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

// Fails the test where there is nothing to replace.
inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

class SourceFolder : public support::FolderTest {
protected:
    void write(const std::string& name, const std::string& text) const { writeFile(folder() / name, text); }
    std::string read(const std::string& name) const { return readFile(folder() / name); }
};

} // namespace reload_test
