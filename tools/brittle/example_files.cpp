#include "tools/brittle/example_files.h"

#include <algorithm>

namespace cli {
namespace {

namespace fs = std::filesystem;

// From the folder of the program: installed, and in build/PRESET/bin.
constexpr const char* kPlaces[] = {"../share/brittle/examples", "../../../modules/brittle/scene/examples"};

fs::path examplesFolder() {
    std::error_code unreadable;
    const fs::path program = fs::read_symlink("/proc/self/exe", unreadable);
    for (const char* place : kPlaces)
        if (const fs::path folder = program.parent_path() / place; fs::is_directory(folder, unreadable))
            return folder.lexically_normal();
    return {};
}

} // namespace

fs::path exampleFile(const std::string& name) {
    const fs::path folder = examplesFolder();
    if (folder.empty() || name.find('/') != std::string::npos) return {};
    std::error_code unreadable;
    return fs::is_regular_file(folder / name, unreadable) ? folder / name : fs::path();
}

std::vector<fs::path> exampleFiles(const std::string& extension) {
    std::vector<fs::path> files;
    std::error_code unreadable;
    if (const fs::path folder = examplesFolder(); !folder.empty())
        for (const auto& entry : fs::directory_iterator(folder, unreadable))
            if (entry.path().extension() == extension) files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

} // namespace cli
