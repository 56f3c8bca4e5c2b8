// Turns what a file holds into a mesh that can be broken.
#pragma once

#include "engine/result.h"
#include "modules/brittle/mesh/imported_mesh.h"

namespace brittle {

// The grid of an event takes any size; volumes, cubes of lengths, stay clear of the ends of float.
// Farther from the origin than so many diagonals doubles are too coarse for the model, and for sites in it.
constexpr double kFarthestModel = 2e10;
constexpr double kMinDiagonal = 1e-10, kMaxDiagonal = 1e10;

// What was done to the mesh on the way, for the doctor.
struct PrepareNotes {
    uint32_t vertices_in = 0; // in the file
    uint32_t unused = 0;      // of those, used by no triangle that is left
    uint32_t welded = 0;      // of the rest, at the place of another
    uint32_t collapsed = 0;   // triangles dropped because two corners are one
    bool turned_inside_out = false;
};

struct PreparedMesh {
    Mesh mesh;
    MeshTopology topology;
    PrepareNotes notes;
};

// The first half of prepareMesh: triangles that share corners, in the file's order and facing as in the file. Normals are the
// file's, zero where it has none.
struct WeldedMesh {
    Mesh mesh;
    PrepareNotes notes;
};
engine::Result<WeldedMesh> weldMesh(const ImportedMesh& imported);

// Leaves out positions that no triangle names: of collapsed triangles.
void dropUnusedPositions(Mesh& mesh);

// The second half: leaves out vertices that no triangle uses, turns an inside-out mesh and completes normals and topology.
// There must be a triangle.
PreparedMesh finishMesh(WeldedMesh welded);

// Both. Moves the box's center to the origin, joins vertices at the same place, drops triangles that have collapsed, turns an
// inside-out mesh the right way round and completes the normals. Whether the result is closed is for checkMesh to say.
// BadInput where coordinates are not finite, or so large or small that floats cannot work with them.
engine::Result<PreparedMesh> prepareMesh(const ImportedMesh& imported);

} // namespace brittle
