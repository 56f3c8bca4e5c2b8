// Names in messages, and what was meant by one that is not known.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace brittle {

// The known name that is fewest letters away (added, left out, replaced, or swapped with the next), the first of several. Empty
// where all are so far away that it would be a guess: by more than a third of the name's letters, rounded up, or more than
// three.
std::string_view nearestName(std::string_view name, std::span<const std::string_view> known);

inline std::string inQuotes(std::string_view name) { return "'" + std::string(name) + "'"; }

// ", did you mean 'friction'?", or `otherwise` where nothing is near.
std::string didYouMean(std::string_view name, std::span<const std::string_view> known, const std::string& otherwise);

} // namespace brittle
