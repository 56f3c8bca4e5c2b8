// Finds and reads the files that a source includes, and remembers which.
#pragma once

#include <glslang/Public/ShaderLang.h>

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace engine {

// All of a file; none where it cannot be read.
std::optional<std::string> readSource(const std::filesystem::path& file);

class IncludeFinder : public glslang::TShader::Includer {
public:
    IncludeFinder(std::filesystem::path file, std::vector<std::filesystem::path> folders);

    // The source itself, what was included, and every place that was tried in vain before: a file that appears there is meant
    // from then on.
    const std::set<std::filesystem::path>& files() const { return files_; }

    IncludeResult* includeLocal(const char* name, const char* from, size_t depth) override;
    // There are no folders of the system; it is asked after a search in vain, and has the last word on why.
    IncludeResult* includeSystem(const char* name, const char* from, size_t depth) override;
    void releaseInclude(IncludeResult* result) override;

private:
    IncludeResult* tryIn(const std::filesystem::path& folder, const char* name);

    std::vector<std::filesystem::path> folders_;
    std::vector<std::filesystem::path> chain_; // folders of the files that are being included, outermost first
    std::set<std::filesystem::path> files_;
};

} // namespace engine
