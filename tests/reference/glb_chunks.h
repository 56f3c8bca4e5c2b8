// The two halves of a GLB file, and numbers out of them. All of these throw std::runtime_error where something cannot be read.
#pragma once

#include "tests/reference/geometry.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace reference {

struct GlbChunks {
    nlohmann::json json;
    std::vector<char> binary;
};

void requireGlb(bool condition, const std::string& what);
GlbChunks readGlbChunks(const std::string& path);
// The accessor's numbers, whatever their type, in rows of its component count.
std::vector<double> readAccessor(const GlbChunks& glb, const nlohmann::json& index);
Point row(const std::vector<double>& numbers, size_t k);
Point pointOf(const nlohmann::json& list);

} // namespace reference
