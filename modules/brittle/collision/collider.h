// Convex pieces to collide with, one for every fragment, as fracture leaves them.
//
// A piece is the Voronoi cell of its fragment cut by the fragment's support planes, so pieces of different cells never overlap,
// and a piece holds its fragment but for a few steps of the event's grid. Islands of one cell are parted by a plane between
// them; where there is none the pair is listed. A body is a range of pieces: a broken object has a body for every fragment, an
// unbroken one that is not convex is a compound of its cells' pieces.
#pragma once

#include "engine/result.h"
#include "modules/brittle/mesh/mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace brittle {

enum class ColliderFaceKind : uint32_t { OfCell, BetweenIslands, OfSurface, Direction };

// What a piece had to do without, for want of planes (64 at most); bits.
enum ColliderLack : uint32_t {
    kLacksDirections = 1, // it is looser than asked for
    kLacksSurfaces = 2,   // the same; the fragment has more planes than are looked for
    kLacksPartings = 4,   // it may reach into other islands of its cell
    kLacksCell = 8,       // it may reach out of its cell
};

struct ColliderFace {
    Float3 normal = {0, 0, 0}; // outward, unit
    float height = 0;          // of the plane along it, from FragmentSet::center, model units
    uint32_t first_corner = 0; // in ColliderSet::corners, of a loop that is counter-clockwise seen from outside
    uint32_t corner_count = 0;
    uint32_t neighbor = 0xffffffff; // the cell on the other side, of faces OfCell; what is no cell is the event's box
    ColliderFaceKind kind = ColliderFaceKind::OfCell;
};
static_assert(sizeof(ColliderFace) == 32);

struct ColliderPiece {
    uint32_t first_face = 0, face_count = 0;
    uint32_t first_vertex = 0, vertex_count = 0;
    uint32_t first_corner = 0, corner_count = 0;
    uint32_t cell = 0;  // as Fragment::cell
    uint32_t lacks = 0; // ColliderLack
};
static_assert(sizeof(ColliderPiece) == 32);

struct ColliderBody {
    uint32_t first_piece = 0, piece_count = 0;
};

// Piece k belongs to fragment k. Empty where no colliders were asked for.
struct ColliderSet {
    std::vector<ColliderPiece> pieces;
    std::vector<ColliderFace> faces;
    std::vector<Float3> vertices;  // relative to FragmentSet::center, as the vertices of fragments
    std::vector<uint32_t> corners; // vertices, counted from the piece's first
    // Fragments of one cell whose pieces overlap and do not collide until they have come apart; the lower one first, in order.
    std::vector<std::array<uint32_t, 2>> overlapping;
};

// All pieces as one body: the object that is not broken yet.
ColliderBody wholeBody(const ColliderSet& colliders);
// A fragment on its own. BadInput where there is no such piece.
engine::Result<ColliderBody> bodyOf(const ColliderSet& colliders, uint32_t fragment);

// Model units cubed, by the divergence theorem over the fans of its faces.
double volumeOf(const ColliderSet& colliders, const ColliderPiece& piece);
// The faces as fans: vertices, counted from the piece's first, three a triangle.
std::vector<uint32_t> trianglesOf(const ColliderSet& colliders, const ColliderPiece& piece);

} // namespace brittle
