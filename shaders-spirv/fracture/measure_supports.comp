// How far each fragment reaches in PAIRS pairs of opposite directions: heights in whole numbers, a workgroup a fragment.
// Cavities lie inside and change nothing.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "lib/kernel.glsl"
#include "shared/collider.h"
#include "lib/support_directions.glsl"
#include "lib/support_plane.glsl"

GROUP_KERNEL;
READS(0, uint, counts);
READS(1, uvec2, fragment_list);
READS(2, uint, component_start);
READS(3, uint, order);
READS(4, uvec4, pieces);
READS(5, vec4, positions);
WRITES(6, int, supports);
layout(push_constant) uniform Push { float fine; }; // units of height in a model unit

shared int highest[2 * PAIRS * GROUP_SIZE]; // a direction's, then the next one's

int highs[PAIRS];
int lows[PAIRS];

// Products with numbers that the compiler knows, and no loop turns: a fragment may have millions of triangles.
void measure(vec3 position) {
    ivec3 p = fineOf(position, fine);
    [[unroll]] for (uint k = 0u; k < PAIRS; k++) {
        ivec3 n = supportDirection(2u * k);
        int height = n.x * p.x + n.y * p.y + n.z * p.z;
        highs[k] = max(highs[k], height);
        lows[k] = min(lows[k], height);
    }
}

void main() {
    uint f = flatGroup(), lane = gl_LocalInvocationID.x;
    bool idle = f >= counts[COUNT_FRAGMENTS] || counts[STATUS_FAILED] != 0u;
    uint c = idle ? 0u : fragment_list[f].x;
    uint first = idle ? 0u : component_start[c], last = idle ? 0u : component_start[c + 1u];
    [[unroll]] for (uint k = 0u; k < PAIRS; k++) {
        highs[k] = -0x7fffffff;
        lows[k] = 0x7fffffff;
    }
    for (uint k = first + lane; k < last; k += GROUP_SIZE) {
        uvec4 piece = pieces[order[k]];
        measure(positions[piece.x].xyz);
        measure(positions[piece.y].xyz);
        measure(positions[piece.z].xyz);
    }
    [[unroll]] for (uint k = 0u; k < PAIRS; k++) {
        highest[2u * k * GROUP_SIZE + lane] = highs[k];
        highest[(2u * k + 1u) * GROUP_SIZE + lane] = -lows[k];
    }
    barrier();
    if (lane >= 2u * PAIRS || idle) return;
    int height = -0x7fffffff;
    for (uint k = 0u; k < ROLLED(GROUP_SIZE); k++) height = max(height, highest[lane * GROUP_SIZE + (k + lane) % GROUP_SIZE]);
    supports[f * SUPPORT_DIRECTIONS + lane] = height;
}
