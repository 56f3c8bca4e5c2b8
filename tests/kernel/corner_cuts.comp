// lib/exact_cut.glsl on one question a lane: does the last site cut the corner of the first one's cell?
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/exact_cut.glsl"

FLAT_KERNEL;
READS(0, ivec4, inputs); // self, three planes (a site, or axis and coordinate with a wall's id), cutter; w: id
WRITES(1, int, verdicts);
layout(push_constant) uniform Push { uint length; };

Plane planeFrom(ivec4 self, ivec4 p) {
    Plane plane;
    plane.id = uint(p.w);
    plane.d = p.xyz - self.xyz;
    plane.r = int64_t(plane.d.x) * int64_t(plane.d.x) + int64_t(plane.d.y) * int64_t(plane.d.y) +
              int64_t(plane.d.z) * int64_t(plane.d.z);
    if (plane.id >= BOX_BASE) {
        bool high = ((plane.id - BOX_BASE) & 1u) != 0u;
        plane.d = ivec3(0);
        plane.d[p.x] = high ? 1 : -1;
        plane.r = int64_t(2 * (high ? p.y - self[p.x] : self[p.x] - p.y));
    }
    return plane;
}

void main() {
    uint k = flatIndex();
    if (k >= length) return;
    ivec4 self = inputs[5u * k];
    Plane a = planeFrom(self, inputs[5u * k + 1u]), b = planeFrom(self, inputs[5u * k + 2u]);
    Plane c = planeFrom(self, inputs[5u * k + 3u]), e = planeFrom(self, inputs[5u * k + 4u]);
    int turned = wideSign(volumeOf(a.d, b.d, c.d));
    if (turned < 0) {
        Plane swap = b;
        b = c;
        c = swap;
    }
    int side = sideOf(cornerOf(a, b, c), e);
    bool cuts = side > 0 || (side == 0 && tieCuts(uint(self.w), a, b, c, e));
    verdicts[k] = turned == 0 ? -1 : int(cuts);
}
