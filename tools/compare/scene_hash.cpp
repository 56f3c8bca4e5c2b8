#include "tools/compare/scene_hash.h"

#include "modules/brittle/mesh/byte_hash.h"
#include "modules/brittle/scene/scene_file.h"
#include "tools/brittle/scene_files.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace compare {
namespace {

void add(brittle::ByteHash& hash, const std::string& text) { hash.add(std::as_bytes(std::span(text))); }

bool isOfNumber(char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+' || c == 'e'; }

// Adds text, in which long fractions are shortened.
void addRounded(brittle::ByteHash& hash, const std::string& text) {
    constexpr size_t kLong = 8; // characters
    for (size_t at = 0, end = 0; at < text.size(); at = end) {
        while (end < text.size() && isOfNumber(text[end]))
            ++end;
        std::string word = text.substr(at, std::max<size_t>(end - at, 1));
        end = at + word.size();
        if (word.size() > kLong && word.find('.') != std::string::npos) {
            char shortened[32];
            std::snprintf(shortened, sizeof shortened, "%.6g", std::strtod(word.c_str(), nullptr));
            word = shortened;
        }
        add(hash, word);
    }
}

void addFile(brittle::ByteHash& hash, const std::filesystem::path& path) {
    std::error_code unknown;
    if (!std::filesystem::is_regular_file(path, unknown)) return;
    std::ifstream file(path, std::ios::binary);
    add(hash, std::string{std::istreambuf_iterator<char>(file), {}});
}

} // namespace

uint64_t hashOfScene(brittle::SceneDescription scene, const std::filesystem::path& folder) {
    scene.comment.clear();
    scene.camera = {};
    scene.step.steps = brittle::StepDescription{}.steps;
    brittle::ByteHash hash;
    addRounded(hash, brittle::writeScene(scene));
    for (const std::filesystem::path& file : cli::modelFilesOf(scene, folder))
        addFile(hash, file);
    return hash.value();
}

} // namespace compare
