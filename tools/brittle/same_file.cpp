#include "tools/brittle/same_file.h"

#include <filesystem>

namespace cli {

bool sameFile(const std::string& a, const std::string& b) {
    if (a.empty() || b.empty()) return false;
    std::error_code ignored;
    if (std::filesystem::equivalent(a, b, ignored)) return true;
    const auto canonical = [&](const std::string& path) {
        return std::filesystem::weakly_canonical(std::filesystem::absolute(path, ignored), ignored);
    };
    return canonical(a) == canonical(b);
}

} // namespace cli
