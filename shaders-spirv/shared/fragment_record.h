// One component of the surface of the pieces, and what becomes of it, in units of the event's box (half its edge is 1): in
// model units the volume of a model of 1e-9 would be no number any more. Read by C++ and GLSL; four-word members only, so that
// std430 and C++ agree.
#ifndef BRITTLE_SHARED_FRAGMENT_RECORD_H
#define BRITTLE_SHARED_FRAGMENT_RECORD_H

#ifdef __cplusplus
#include <cstdint>
namespace brittle {
using RecordFloat4 = float[4];
using RecordUint4 = uint32_t[4];
#else
#define RecordFloat4 vec4
#define RecordUint4 uvec4
#endif

struct FragmentRecord {
    RecordFloat4 measure;  // volume, area, outer area, perimeter of all triangles
    RecordFloat4 balance;  // center of mass, relative to the mesh's center; w unused
    RecordFloat4 squares;  // xx yy zz of the second moments of volume about the center of mass; w unused
    RecordFloat4 products; // and xy xz yz; w unused
    RecordFloat4 low;      // bounds, relative to the mesh's center
    RecordFloat4 high;
    RecordUint4 fate;      // FATE_*, the component it belongs to, cell, outer triangles that lie on faces of earlier cuts
    RecordUint4 range;     // fragment, first triangle in the pools, outer triangles, inner triangles
};

#ifdef __cplusplus
static_assert(sizeof(FragmentRecord) == 128);
} // namespace brittle
#endif
#endif
