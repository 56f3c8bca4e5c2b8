#include "modules/brittle/fracture/refracture.h"

#include "modules/brittle/mesh/format.h"
#include "modules/brittle/mesh/topology.h"
#include "modules/brittle/mesh/vector_math.h"
#include "modules/brittle/mesh/welder.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace brittle {
namespace {

engine::Error badFragment(size_t fragment, const std::string& what) {
    return {engine::ErrorCode::BadInput, "fragment " + std::to_string(fragment) + " " + what};
}

const FragmentVertex& cornerOf(const FragmentSet& set, const Fragment& fragment, uint32_t corner) {
    return set.vertices[fragment.first_vertex + set.indices[fragment.first_index + corner]];
}

uint32_t cornerCount(const Fragment& fragment) { return fragment.outer_index_count + fragment.inner_index_count; }

// Within a factor of two of each other the difference of two floats is a float (Sterbenz). A box that is longer than that along
// an axis is not far from the center, measured by its own length, and stays where it is.
Double3 exactShift(const Box& box) {
    Double3 shift = {0, 0, 0};
    for (size_t k = 0; k < 3; ++k) {
        const double low = std::min(std::abs(box.lower[k]), std::abs(box.upper[k]));
        const double high = std::max(std::abs(box.lower[k]), std::abs(box.upper[k]));
        const bool is_aside = (box.lower[k] > 0) == (box.upper[k] > 0) && high <= 2 * low;
        if (is_aside) shift[k] = static_cast<float>((box.lower[k] + box.upper[k]) / 2);
    }
    return shift;
}

Box boxOf(const FragmentSet& set, const Fragment& fragment) {
    Box box;
    for (uint32_t c = 0; c < cornerCount(fragment); ++c)
        box.grow(positionOf(cornerOf(set, fragment, c)));
    return box;
}

void addCorner(Mesh& mesh, const FragmentVertex& v) {
    mesh.corner_normals.push_back({v.normal[0], v.normal[1], v.normal[2]});
    mesh.corner_uvs.push_back({v.uv[0], v.uv[1]});
}

// Collapsed triangles bound nothing: their edges are one edge, there and back.
void addTriangles(const FragmentSet& set, const Fragment& fragment, const Double3& shift, PreparedMesh& prepared) {
    Mesh& mesh = prepared.mesh;
    const uint32_t count = cornerCount(fragment);
    const uint32_t own = fragment.outer_index_count - fragment.earlier_index_count;
    Welder welder(count);
    for (uint32_t first = 0; first < count; first += 3) {
        if (first == own) mesh.own_triangles = static_cast<uint32_t>(mesh.triangles.size());
        Index3 t;
        for (uint32_t k = 0; k < 3; ++k)
            t[k] = welder.indexOf(toFloat(positionOf(cornerOf(set, fragment, first + k)) - shift), mesh.positions);
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
            ++prepared.notes.collapsed;
            continue;
        }
        mesh.triangles.push_back(t);
        for (uint32_t k = 0; k < 3; ++k)
            addCorner(mesh, cornerOf(set, fragment, first + k));
    }
    prepared.notes.vertices_in = count;
    prepared.notes.welded = count - static_cast<uint32_t>(mesh.positions.size());
}

bool isClosed(const MeshTopology& topology) {
    return std::ranges::find(topology.half_edge_mates, kNoMate) == topology.half_edge_mates.end();
}

} // namespace

engine::Result<PreparedMesh> prepareFragment(const FragmentSet& set, size_t fragment) {
    if (fragment >= set.fragments.size())
        return badFragment(fragment, "is asked for, but there are " + std::to_string(set.fragments.size()) + "; count from 0");
    const Fragment& from = set.fragments[fragment];
    const Box box = boxOf(set, from);
    if (!(box.diagonal() >= kMinDiagonal))
        return badFragment(fragment, "is " + formatNumber(box.diagonal()) + " units large; leave it whole");
    const Double3 shift = exactShift(box);
    PreparedMesh prepared;
    prepared.mesh.center = set.center + shift;
    addTriangles(set, from, shift, prepared);
    if (prepared.mesh.triangles.empty()) return badFragment(fragment, "has collapsed to lines and points; leave it whole");
    dropUnusedPositions(prepared.mesh);
    prepared.topology = buildTopology(prepared.mesh);
    if (!isClosed(prepared.topology)) return badFragment(fragment, "is not closed; break fragments as shatter made them");
    return prepared;
}

} // namespace brittle
