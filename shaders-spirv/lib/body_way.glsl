// From A's center of mass to B's, world axes. Wants `bodies` declared.
#include "shared/body.h"

vec3 wayBetween(uint a, uint b) {
    return vec3(bodies[b].sector.xyz - bodies[a].sector.xyz) * float(SECTOR_EDGE) + (bodies[b].offset.xyz - bodies[a].offset.xyz);
}
