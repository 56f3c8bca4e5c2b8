#include "tests/support/planted_kernel.h"

#include "engine/kernel_interface.h"
#include "shaders-spirv/embedded.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace support {
namespace {

[[noreturn]] void giveUp(const std::string& why) {
    std::fprintf(stderr, "%s\n", why.c_str());
    std::_Exit(2); // not the code of a test that fails
}

std::vector<uint32_t> wordsOfFile(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    if (bytes.empty() || bytes.size() % 4 != 0) giveUp(path + " is no SPIR-V file");
    std::vector<uint32_t> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), bytes.size());
    return words;
}

// Constants and sizes of workgroups are those of the planted words, for a library reads them from these.
void checkInterface(const shaders::Module& built, const std::vector<uint32_t>& words) {
    using Of = engine::InterfaceChange::Of;
    const auto host = engine::reflect(built.words), now = engine::reflect(words);
    if (!host) giveUp(host.error().message);
    if (!now) giveUp(now.error().message);
    for (const engine::InterfaceChange& change : engine::interfaceChanges(*host, *now))
        if (change.of != Of::Constant && change.of != Of::GroupSize)
            giveUp("kernel \"" + std::string(built.name) + "\": " + change.why);
}

} // namespace

void plantKernel() {
    const char* variable = std::getenv("BRITTLE_TEST_KERNEL");
    if (variable == nullptr) return;
    const std::string planted = variable;
    const size_t split = planted.find('=');
    if (split == std::string::npos) giveUp("BRITTLE_TEST_KERNEL is " + planted + ", expected NAME=FILE.spv");
    const auto built = std::ranges::find(shaders::all(), planted.substr(0, split), &shaders::Module::name);
    if (built == shaders::all().end()) giveUp("no kernel is named \"" + planted.substr(0, split) + "\"");
    static std::vector<uint32_t> words; // every library of the program refers to them
    words = wordsOfFile(planted.substr(split + 1));
    checkInterface(*built, words);
    // The rows are elements of a vector, so none of them is a constant object.
    const_cast<shaders::Module&>(*built).words = words;
}

} // namespace support
