// A body leaves the world: its slot is absent, with no mass, no motion and no pieces, and cannot break; what it had of the pools goes
// back to them. Wants `shapes`, `hulls`, `bodies`, `breakable` and `pieces` declared.
#include "lib/face_room.glsl"

// Hulls of a body follow each other.
PoolShare shareOf(uint body) {
    uvec2 range = shapes[body].pieces.xy;
    uvec4 surface = breakable[body].surface;
    HullRecord first = hulls[pieces[range.x].ids.x], last = hulls[pieces[range.x + range.y - 1u].ids.x];
    PoolShare share;
    share.begin = uvec4(body, range.x, first.first.y, surface.x / 3u);
    share.size = uvec4(1u, range.y, last.first.y + faceRoom(last.count) - first.first.y, (surface.y + surface.z) / 3u);
    return share;
}

void leaveWorld(uint body) {
    uvec2 range = shapes[body].pieces.xy;
    for (uint p = 0u; p < range.y; p++) pieces[range.x + p].ids.y = NO_INDEX;
    breakable[body].surface = uvec4(0u, 0u, 0u, NO_INDEX);
    bodies[body].sector.w = BODY_ABSENT;
    bodies[body].offset.w = 0.0;
    bodies[body].velocity = vec4(0.0);
    bodies[body].spin = vec4(0.0);
    bodies[body].momentum = vec4(0.0);
}
