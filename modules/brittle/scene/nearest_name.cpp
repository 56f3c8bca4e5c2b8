#include "modules/brittle/scene/nearest_name.h"

#include <algorithm>
#include <vector>

namespace brittle {
namespace {

constexpr size_t kLongestName = 64;

// Damerau's distance, in which a letter moves once at most (optimal string alignment).
size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::vector<size_t>> steps(a.size() + 1, std::vector<size_t>(b.size() + 1));
    for (size_t i = 0; i <= a.size(); ++i)
        for (size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                steps[i][j] = i + j;
                continue;
            }
            const size_t replaced = steps[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            steps[i][j] = std::min({replaced, steps[i - 1][j] + 1, steps[i][j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                steps[i][j] = std::min(steps[i][j], steps[i - 2][j - 2] + 1);
        }
    return steps[a.size()][b.size()];
}

} // namespace

std::string_view nearestName(std::string_view name, std::span<const std::string_view> known) {
    if (name.size() > kLongestName) return {};
    std::string_view nearest;
    size_t least = std::min<size_t>(3, (name.size() + 2) / 3) + 1;
    for (const std::string_view candidate : known)
        if (const size_t d = distance(name, candidate); d < least) {
            least = d;
            nearest = candidate;
        }
    return nearest;
}

std::string didYouMean(std::string_view name, std::span<const std::string_view> known, const std::string& otherwise) {
    const std::string_view nearest = nearestName(name, known);
    return nearest.empty() ? otherwise : ", did you mean '" + std::string(nearest) + "'?";
}

} // namespace brittle
