// same_fragments A.glb B.glb: exit code 0 if two files hold the same fragments: the same pieces of the same cells, with the
// same triangles in the same order at the same positions, bit for bit. Normals, texture coordinates and mass properties are
// computed in floats, whose last bits Vulkan leaves to the driver (divisions may be off by 2.5 units in the last place, sums of
// products may be contracted), so they may differ by the bounds below. Prints the largest differences.
#include "tests/reference/glb_chunks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>

namespace {

using nlohmann::json;
using reference::GlbChunks;

struct Bound {
    double difference; // relative to the largest number of its list
    double scale = 1;  // that number is taken for at least this
};

// Inertia is shifted from a corner of the fragment to its center of mass, which cancels up to a digit.
const std::map<std::string, Bound> kBounds = {
    {"POSITION", {0}}, {"NORMAL", {1e-6}},    {"TEXCOORD_0", {1e-6}},     {"site", {0}},
    {"cell", {0}},     {"volume", {1e-6, 0}}, {"center_of_mass", {1e-6}}, {"inertia", {1e-5, 0}}};

std::map<std::string, double> largest_difference;

void require(bool condition, const std::string& what) {
    if (condition) return;
    std::printf("differ: %s\n", what.c_str());
    std::exit(EXIT_FAILURE);
}

void compare(const std::string& kind, const std::vector<double>& a, const std::vector<double>& b, const std::string& where) {
    const auto bound = kBounds.find(kind);
    require(bound != kBounds.end(), where + ": " + kind + " is unknown to this check");
    require(a.size() == b.size(), where + ": the number of values of " + kind);
    double scale = bound->second.scale, difference = 0;
    for (size_t k = 0; k < a.size(); ++k) {
        require(std::isfinite(a[k]) && std::isfinite(b[k]), where + ": " + kind + " is NaN or infinite");
        scale = std::max(scale, std::abs(a[k]));
        difference = std::max(difference, std::abs(a[k] - b[k]));
    }
    if (difference == 0) return;
    double& largest = largest_difference[kind];
    largest = std::max(largest, difference / scale);
    require(difference <= bound->second.difference * scale, where + ": " + kind + " by " + std::to_string(difference));
}

// The attribute of each corner of each triangle: files that share vertices otherwise compare equal.
std::vector<double> cornersOf(const GlbChunks& glb, const json& primitive, const std::string& attribute) {
    const std::vector<double> values = reference::readAccessor(glb, primitive["attributes"][attribute]);
    const size_t width = attribute == "TEXCOORD_0" ? 2 : 3;
    std::vector<double> corners;
    for (const double index : reference::readAccessor(glb, primitive["indices"]))
        for (size_t k = 0; k < width; ++k)
            corners.push_back(values.at(static_cast<size_t>(index) * width + k));
    return corners;
}

void compareMeshes(const GlbChunks& a, const GlbChunks& b, const json& mesh_a, const json& mesh_b, const std::string& where) {
    require(mesh_a["primitives"].size() == mesh_b["primitives"].size(), where + ": the number of primitives");
    for (size_t p = 0; p < mesh_a["primitives"].size(); ++p) {
        const json &one = mesh_a["primitives"][p], &other = mesh_b["primitives"][p];
        require(one["material"] == other["material"], where + ": the material");
        for (const auto& [attribute, index] : one["attributes"].items())
            compare(attribute, cornersOf(a, one, attribute), cornersOf(b, other, attribute), where);
    }
}

std::vector<double> numbersOf(const json& value) {
    return value.is_array() ? value.get<std::vector<double>>() : std::vector<double>{value.get<double>()};
}

// Returns the value as text, empty if the node has no such key.
std::string textOf(const json& node, const char* key) { return node.contains(key) ? node[key].dump() : ""; }

void compareNodes(const GlbChunks& a, const GlbChunks& b) {
    const json &nodes = a.json["nodes"], &others = b.json["nodes"];
    require(nodes.size() == others.size() && !nodes.empty(), "the number of nodes");
    for (size_t n = 0; n < nodes.size(); ++n) {
        const json &one = nodes[n], &other = others[n];
        const std::string name = textOf(one, "name");
        for (const char* key : {"name", "translation", "mesh"})
            require(textOf(one, key) == textOf(other, key), name + ": " + key);
        if (!one.contains("mesh")) continue;
        for (const auto& [key, value] : one["extras"].items())
            compare(key, numbersOf(value), numbersOf(other["extras"][key]), name);
        const size_t mesh = one["mesh"].get<size_t>();
        compareMeshes(a, b, a.json["meshes"][mesh], b.json["meshes"][mesh], name);
    }
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 3) return std::fprintf(stderr, "usage: same_fragments A.glb B.glb\n"), 2;
    try {
        compareNodes(reference::readGlbChunks(argv[1]), reference::readGlbChunks(argv[2]));
    } catch (const std::exception& thrown) {
        std::fprintf(stderr, "same_fragments: %s\n", thrown.what());
        return EXIT_FAILURE;
    }
    for (const auto& [kind, difference] : largest_difference)
        std::printf("%s %.2g  ", kind.c_str(), difference);
    std::printf("\n");
    return EXIT_SUCCESS;
}
