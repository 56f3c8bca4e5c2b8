#include "tools/device_check/spawn.h"

#include <unistd.h>

namespace device_check {
namespace {

std::vector<char*> pointersTo(std::vector<std::string>& words) {
    std::vector<char*> pointers;
    for (std::string& word : words)
        pointers.push_back(word.data());
    pointers.push_back(nullptr);
    return pointers;
}

std::vector<std::string> environmentWith(const std::vector<std::string>& settings) {
    std::vector<std::string> all;
    for (char** inherited = environ; *inherited != nullptr; ++inherited)
        all.emplace_back(*inherited);
    for (const std::string& setting : settings) {
        const std::string name = setting.substr(0, setting.find('=') + 1);
        std::erase_if(all, [&](const std::string& known) { return known.starts_with(name); });
        all.push_back(setting);
    }
    return all;
}

} // namespace

int spawnProgram(std::vector<std::string> words, const std::vector<std::string>& settings,
                 const posix_spawn_file_actions_t& files, const posix_spawnattr_t* attributes, pid_t& pid) {
    std::vector<std::string> environment = environmentWith(settings);
    return posix_spawn(&pid, words[0].c_str(), &files, attributes, pointersTo(words).data(), pointersTo(environment).data());
}

} // namespace device_check
