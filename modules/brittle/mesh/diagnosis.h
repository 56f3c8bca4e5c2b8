// All that can be said about a surface, with places: what `brittle doctor` prints. Slower than the check, and of no
// consequence for it.
#pragma once

#include "modules/brittle/mesh/check.h"

#include <optional>

namespace brittle {

// A triangle whose longest side is this many times its height is a sliver, one of kFlatAspect has no area at all.
constexpr double kSliverAspect = 100;

// All places are in model space.
struct MeshDiagnosis {
    // Hangs together by edges of two triangles, or by edges of more where it would not close there alone.
    struct Part {
        Double3 where = {0, 0, 0}; // in the middle of its first triangle
        uint32_t triangles = 0, vertices = 0, edges = 0;
        uint32_t rims = 0;             // where it is open
        bool is_one_sided = false;     // like a Moebius strip
        std::optional<uint32_t> genus; // tunnels through it, were its rims closed; none for what is one-sided or branches
        double volume = 0, area = 0;   // volume as its triangles face: negative for the wall of a hollow
    };
    struct Hole {
        uint32_t edges = 0;
        double length = 0, diameter = 0; // of the rim and of its box, in model units
        Double3 where = {0, 0, 0};       // the middle of its edges
        bool is_simple = false;          // a closed loop that passes no vertex twice
    };
    struct Sliver {
        double aspect = 0; // infinite: none
        Double3 where = {0, 0, 0};
    };
    struct Crossing {
        double depth = 0; // in model units
        Double3 where = {0, 0, 0};
        std::array<uint32_t, 2> triangles;
    };
    MeshReport report;
    std::vector<Part> parts;
    std::vector<Hole> holes;
    std::vector<Crossing> crossings;           // the deepest first
    std::vector<Sliver> slivers;               // the worst first; those without area among them
    std::vector<Double3> nonmanifold_edges;    // more than two triangles, also where they pair up
    std::vector<Double3> nonmanifold_vertices; // where sheets meet that share no edge there
    std::vector<Double3> inconsistent_edges;   // two triangles that disagree on the front
    std::vector<Double3> duplicates;           // triangles with the corners of an earlier one
    std::vector<Double3> folds;                // edges at which a face lies on its neighbor
};

MeshDiagnosis diagnoseMesh(const Mesh& mesh, const MeshTopology& topology);

} // namespace brittle
