// What bodies look like: surfaces in the frames of their bodies, whose origin is the center of mass and whose axes are the
// principal ones.
#pragma once

#include "modules/brittle/dynamics/world_contents.h"
#include "modules/brittle/fracture/fragments.h"
#include "modules/brittle/mesh/imported_mesh.h"
#include "modules/brittle/scene/hull/convex_hull.h"

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace brittle {

struct SurfaceMesh {
    std::vector<FragmentVertex> vertices; // meters
    std::vector<uint32_t> indices;        // three a triangle, counterclockwise seen from outside
    uint32_t outer_index_count = 0;       // the first ones; what follows are cut faces
};

struct BodyLook {
    uint32_t mesh = 0;
    std::string name;
    bool moves = false;
    bool is_plane = false;               // its mesh is a square, of which only the middle is meant: a plane has no end
    std::optional<uint32_t> origin = {}; // of a fragment the first body that it was a part of, of these
    std::string material = {};           // by name; empty if the body has none
};

struct WorldSurfaces {
    std::vector<SurfaceMesh> meshes;
    std::vector<BodyLook> bodies; // as the world has them
};

// Flat faces, about `center`.
SurfaceMesh surfaceOf(const ConvexHull& hull, const Double3& center);
SurfaceMesh surfaceOf(const FragmentSet& set, const Fragment& fragment, const Double3& center);
SurfaceMesh surfaceOf(const Mesh& mesh, const Double3& center);
// Triangles without a normal get their own.
SurfaceMesh surfaceOf(const ImportedMesh& model);
// In the plane of x and z, seen from above.
SurfaceMesh squareSurface(double edge);

// Collects what the bodies of a world look like, in their order. Surfaces that are equal, bit for bit, are kept once.
class SurfaceCollector {
public:
    explicit SurfaceCollector(WorldSurfaces& surfaces) : surfaces_(surfaces) {}
    // `surface` in the frame that `body` is described in.
    void add(const BodyDefinition& body, SurfaceMesh surface, bool is_plane);

private:
    uint32_t indexOf(SurfaceMesh surface);

    WorldSurfaces& surfaces_;
    std::unordered_multimap<uint64_t, uint32_t> by_hash_;
};

} // namespace brittle
