#include "tools/device_check/kit.h"

#include "tools/device_check/cached_start.h"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace device_check {

namespace fs = std::filesystem;

ChildCommand Kit::command(const std::string& program, const std::vector<std::string>& arguments,
                          Clock::time_point until) const {
    ChildCommand command;
    command.words = launcher_;
    command.words.push_back((folder_ / "bin" / program).string());
    command.words.insert(command.words.end(), arguments.begin(), arguments.end());
    // Without copies, tests read the tree that they were built from.
    if (fs::exists(folder_ / "source"))
        command.environment = {"BRITTLE_TEST_SOURCE=" + (folder_ / "source").string(),
                               "BRITTLE_TEST_MODULES=" + (folder_ / "modules").string()};
    if (!cache_.empty())
        for (std::string& setting : cacheSettings(cache_))
            command.environment.push_back(std::move(setting));
    if (!device_.empty()) command.environment.push_back("BRITTLE_DEVICE=" + device_);
    command.until = until;
    return command;
}

// Lines "NAME SOURCE"; # begins a comment (tests/device/meshes.txt).
std::vector<std::pair<std::string, std::string>> Kit::models() const {
    std::vector<std::pair<std::string, std::string>> models;
    std::ifstream list(folder_ / "meshes.txt");
    for (std::string line; std::getline(list, line);) {
        std::istringstream words(line);
        std::string name, source;
        if (!(words >> name >> source) || name.starts_with('#')) continue;
        models.emplace_back(name, source.starts_with("builtin:") ? source : (folder_ / "meshes" / source).string());
    }
    return models;
}

std::vector<fs::path> Kit::recordings() const {
    std::vector<fs::path> files;
    std::error_code none;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / "recordings", none))
        if (entry.path().extension() == ".motion") files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

std::vector<std::string> Kit::scenes() const {
    std::vector<std::string> names;
    std::ifstream list(folder_ / "scenes.txt");
    for (std::string name; list >> name;)
        names.push_back(name);
    return names;
}

Json Kit::expected(std::string& problem) const {
    std::ifstream file(folder_ / "expected.json");
    if (!file) problem = "expected.json is missing";
    if (!file) return {};
    Json expected = Json::parse(file, nullptr, /*allow_exceptions=*/false);
    const auto has = [&](const char* list) {
        return expected.is_object() && expected.contains(list) && expected[list].is_array() && !expected[list].empty();
    };
    if (has("models") && has("scenes")) return expected;
    problem = "expected.json is damaged";
    return {};
}

} // namespace device_check
