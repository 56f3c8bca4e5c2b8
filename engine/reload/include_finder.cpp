#include "engine/reload/include_finder.h"

#include <fstream>
#include <iterator>

namespace engine {

namespace fs = std::filesystem;

namespace {

constexpr size_t kDeepest = 64; // a file that includes itself without a guard ends here
constexpr std::string_view kTooDeep = "included too deep; a file that includes itself needs a guard";

} // namespace

std::optional<std::string> readSource(const fs::path& file) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return std::nullopt;
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return std::nullopt;
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (stream.bad()) return std::nullopt;
    return text;
}

IncludeFinder::IncludeFinder(fs::path file, std::vector<fs::path> folders) : folders_(std::move(folders)) {
    files_.insert(file.lexically_normal());
}

IncludeFinder::IncludeResult* IncludeFinder::includeLocal(const char* name, const char* from, size_t depth) {
    if (depth > kDeepest) return nullptr;
    chain_.resize(depth);
    chain_.back() = fs::path(from).parent_path();
    for (auto folder = chain_.rbegin(); folder != chain_.rend(); ++folder)
        if (IncludeResult* found = tryIn(*folder, name)) return found;
    for (const fs::path& folder : folders_)
        if (IncludeResult* found = tryIn(folder, name)) return found;
    return nullptr;
}

IncludeFinder::IncludeResult* IncludeFinder::includeSystem(const char*, const char*, size_t depth) {
    if (depth <= kDeepest) return nullptr;
    return new IncludeResult("", kTooDeep.data(), kTooDeep.size(), nullptr);
}

IncludeFinder::IncludeResult* IncludeFinder::tryIn(const fs::path& folder, const char* name) {
    const fs::path file = (folder / name).lexically_normal();
    files_.insert(file);
    auto text = readSource(file);
    if (!text) return nullptr;
    auto* kept = new std::string(std::move(*text));
    return new IncludeResult(file.string(), kept->data(), kept->size(), kept);
}

void IncludeFinder::releaseInclude(IncludeResult* result) {
    if (result == nullptr) return;
    delete static_cast<std::string*>(result->userData);
    delete result;
}

} // namespace engine
