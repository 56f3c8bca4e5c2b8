// Whether a place on the event's grid lies inside the solid: its winding number (lib/winding.glsl).
//
// Wants grid_vertices, triangles, column_start, column_triangles and the push constants low and high declared, and
// lib/wide.glsl.
#include "lib/winding.glsl"

// Some column may have no triangles at all: there is nothing inside of it.
uint columnOf(ivec3 p) { return uint((p.y - low.y) / low.w * high.w + (p.x - low.x) / low.w); }

bool insideSolid(ivec3 p, bool asked, inout uint budget) {
    uint column = asked ? columnOf(p) : 0u, last = asked ? column_start[column + 1u] : 0u;
    int winding = 0;
    for (uint k = asked ? column_start[column] : 0u; k < last && budget > 0u; k++) {
        uint t = column_triangles[k];
        winding += windingAbove(grid_vertices[triangles[3u * t]].xyz, grid_vertices[triangles[3u * t + 1u]].xyz,
                                grid_vertices[triangles[3u * t + 2u]].xyz, p);
        budget -= min(budget, 1u);
    }
    return winding > 0 && budget > 0u;
}
