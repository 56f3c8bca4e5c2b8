// The lowest id at each point's position, and which of these stand for others too.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, point_table);
READS(2, uint, point_slots);
WRITES(3, uint, welded);
WRITES(4, uint, shared_points); // 1 where another point has this one's position; not written elsewhere
layout(push_constant) uniform Push {
    uint length;
    uint length_count;
};

void main() {
    uint id = flatIndex();
    uint n = length_count == NO_INDEX ? length : counts[length_count];
    if (id >= n || counts[STATUS_FAILED] != 0u) return;
    uint lowest = point_table[point_slots[id]] - 1u;
    welded[id] = lowest;
    if (lowest != id) shared_points[lowest] = 1u;
}
