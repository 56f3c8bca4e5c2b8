// Colliders: one convex polyhedron for every fragment, as the kernels leave them and the host reads them. Four-word members
// only, so that std430 and C++ agree.
#ifndef BRITTLE_SHARED_COLLIDER_H
#define BRITTLE_SHARED_COLLIDER_H

// Heights of a fragment are whole numbers of this part of a grid step, relative to the grid's center.
#define HEIGHT_BITS 4
#define SUPPORT_DIRECTIONS 62 /* pairs: 2 k and 2 k + 1 are opposite */

// A collider has at most this many faces, and so, with three faces at every corner, twice as many less four corners.
#define COLLIDER_PLANES 64
#define COLLIDER_CORNERS (2 * COLLIDER_PLANES - 4)
#define MOST_SURFACES 32           /* planes of a fragment's own surface */
#define SURFACE_WORDS (4 + 6 * MOST_SURFACES)
#define SURFACE_VISITS 8192u       /* of triangles, over all rounds in which the planes of one fragment are looked for */
#define PARTING_WORDS 12           /* fragments, found, normal, bounds of either side */
#define MOST_PARTINGS 4096u        /* pairs of islands of one cell that are parted by planes of their own */

// Of a piece that waits to be packed: header, faces, vertices, loops.
#define COLLIDER_FACE_WORDS 6
#define COLLIDER_VERTICES_AT (4 + COLLIDER_FACE_WORDS * COLLIDER_PLANES)
#define COLLIDER_LOOPS_AT (COLLIDER_VERTICES_AT + 3 * COLLIDER_CORNERS)
#define COLLIDER_WORDS (COLLIDER_LOOPS_AT + 3 * COLLIDER_CORNERS)

// Where a face comes from: a neighbor's bisector, a plane between islands, the fragment's surface, a fixed direction.
#define FACE_OF_CELL 0u
#define FACE_PARTING 1u
#define FACE_SURFACE 2u
#define FACE_DIRECTION 3u

// What a piece had to do without, for want of planes. 0: nothing.
#define COLLIDER_LACKS_DIRECTIONS 1u /* it is looser than asked for */
#define COLLIDER_LACKS_SURFACES 2u   /* the same; the fragment has more planes than are looked for */
#define COLLIDER_LACKS_PARTINGS 4u   /* it may reach into other islands of its cell */
#define COLLIDER_LACKS_CELL 8u       /* it may reach out of its cell */

#ifdef __cplusplus
#include <cstdint>
namespace brittle {
using ColliderFloat4 = float[4];
using ColliderUint4 = uint32_t[4];
#else
#define ColliderFloat4 vec4
#define ColliderUint4 uvec4
#endif

struct ColliderRecord {
    ColliderUint4 range; // first face, faces, first vertex, vertices
    ColliderUint4 info;  // first corner of the loops, corners, cell, COLLIDER_LACKS_*
};

struct ColliderFaceRecord {
    ColliderFloat4 plane; // outward unit normal and height, relative to the mesh's center, model units
    ColliderUint4 loop;   // first corner, corners, site of the neighbor or NO_INDEX, FACE_*
};

#ifdef __cplusplus
static_assert(sizeof(ColliderRecord) == 32 && sizeof(ColliderFaceRecord) == 32);
} // namespace brittle
#endif
#endif
