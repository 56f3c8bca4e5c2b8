// The polygons of an event as clip_triangles left them, and where their corners are, worked out again in long doubles from
// the names of their sides.
#pragma once

#include "tests/kernel/device_event.h"

namespace kernel_test {

using Weights = std::array<long double, 3>; // of a triangle's corners, adding up to 1
using LongPoint = std::array<long double, 3>;

struct Polygons {
    const DeviceEvent& event;
    uint32_t count = event[COUNT_POLYGONS];
    std::vector<reference::GridPoint> sites = event.sites(), vertices = event.vertices();
    std::vector<Word4> polygons = event.read<Word4>(event.buffers().polygons, count); // triangle, cell, flat with, pair
    std::vector<Word4> offsets = event.read<Word4>(event.buffers().polygon_offsets, count + 1);
    std::vector<uint32_t> sides = event.read<uint32_t>(event.buffers().polygon_sides, event[COUNT_SIDES]);

    uint32_t sideCount(uint32_t q) const { return offsets[q + 1][0] - offsets[q][0]; }
    uint32_t side(uint32_t q, uint32_t k) const { return sides[offsets[q][0] + k % sideCount(q)]; }
    const reference::GridPoint& corner(uint32_t t, size_t k) const { return vertices[event.mesh().triangles[t][k]]; }
};

// Where two lines of a triangle meet: its edges, or bisectors of a cell with a site.
Weights meetingPoint(const Polygons& p, uint32_t triangle, uint32_t cell, uint32_t side, uint32_t other);
// Corner k lies between sides k and k + 1.
std::vector<Weights> cornersOf(const Polygons& p, uint32_t q);
LongPoint placeOf(const Polygons& p, uint32_t triangle, const Weights& weights);

} // namespace kernel_test
