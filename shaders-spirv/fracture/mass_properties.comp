// Measures each component by the divergence theorem: volume, centroid, second moments, area and bounds. A workgroup measures one
// component and adds in a fixed order. Positions are relative to the component's first corner: small pieces far from the center
// keep their digits. The unit is half the edge of the event's box, so that a model of any size does.
//
// Sheets and needles may have less volume than floats lose in the sum. Their volume is added again in pairs of floats.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/rounded_alike.glsl"
#include "lib/sum.glsl"
#include "lib/double_float.glsl"
#include "shared/fragment_record.h"

GROUP_KERNEL;
READS(0, uint, counts);
READS(1, uint, component_start);
READS(2, uint, order);
READS(3, uvec4, pieces);
READS(4, uint, sources);
READS(5, vec4, positions);
WRITES(6, FragmentRecord, records);
layout(push_constant) uniform Push { float unit; }; // a power of two

shared vec4 sums[GROUP_SIZE];
shared vec4 moments[GROUP_SIZE];
shared vec4 squares[GROUP_SIZE];
shared vec4 products[GROUP_SIZE];
shared vec4 lows[GROUP_SIZE];
shared vec4 highs[GROUP_SIZE];

vec3 cornerOf(uint id) { return positions[id].xyz * unit; }

vec3 pairs(vec3 p) { return p.xxy * p.yzz; }

// The size of the products in six volumes: floats lose at most 2^-22 of it, since differences of corners are exact.
float sizeOfTerms(vec3 a, vec3 u, vec3 v) {
    vec3 p = abs(a), q = abs(u), r = abs(v);
    return dot(p, q.yzx * r.zxy + q.zxy * r.yzx);
}

vec2 added(vec2 a, vec2 b) {
    Double3 sum = sumOf(vec3(a.x), vec3(b.x));
    precise float low = sum.low.x + (a.y + b.y);
    return vec2(sum.high.x, low);
}

Double3 cornerFrom(uint id, vec3 origin) { return sumOf(cornerOf(id), -origin); }

vec2 sixVolumes(uvec4 piece, vec3 origin) {
    Double3 normal = crossOf(cornerFrom(piece.y, origin), cornerFrom(piece.z, origin));
    Double3 part = productOf(cornerFrom(piece.x, origin), normal);
    vec2 sum = vec2(0.0);
    for (uint axis = 0u; axis < ROLLED(3); axis++) sum = added(sum, vec2(part.high[axis], part.low[axis]));
    return sum;
}

// The volume of the triangles from first to last in twice the digits; in lane 0 only.
float volumeInPairs(uint lane, uint first, uint last, vec3 origin) {
    vec2 sum = vec2(0.0);
    for (uint k = first + lane; k < last; k += GROUP_SIZE) sum = added(sum, sixVolumes(pieces[order[k]], origin));
    products[lane].xy = sum;
    barrier();
    for (uint width = ROLLED(GROUP_SIZE / 2u); width > 0u; width >>= 1) {
        if (lane < width) products[lane].xy = added(products[lane].xy, products[lane + width].xy);
        barrier();
    }
    return (products[0].x + products[0].y) / 6.0;
}

void main() {
    uint c = flatGroup(), lane = gl_LocalInvocationID.x;
    bool idle = c >= counts[COUNT_COMPONENTS] || counts[STATUS_FAILED] != 0u;
    uint first = idle ? 0u : component_start[c], last = idle ? 0u : component_start[c + 1u];
    uvec4 lead = pieces[order[first]];
    precise vec3 origin = cornerOf(lead.x);
    vec4 sum = vec4(0.0), moment = vec4(0.0), lost_sum = vec4(0.0), lost_moment = vec4(0.0);
    vec4 square = vec4(0.0), product = vec4(0.0), lost_square = vec4(0.0), lost_product = vec4(0.0);
    vec4 low = vec4(1e38), high = vec4(-1e38);
    for (uint k = first + lane; k < last; k += GROUP_SIZE) {
        uint t = order[k];
        uvec4 piece = pieces[t];
        precise vec3 a = cornerOf(piece.x) - origin, b = cornerOf(piece.y) - origin, d = cornerOf(piece.z) - origin;
        precise vec3 u = b - a, v = d - a, normal = alikeCross(u, v); // of short edges: little to round
        precise float volume = alikeDot(a, normal) / 6.0, area = 0.5 * length(normal);
        float outer_area = (sources[t] & INNER_BIT) == 0u ? area : 0.0, perimeter = length(b - a) + length(d - b) + length(a - d);
        addTo(sum, lost_sum, vec4(volume, area, outer_area, perimeter));
        addTo(moment, lost_moment, vec4(0.25 * volume * (a + b + d), sizeOfTerms(a, u, v)));
        // Of the tetrahedron with the origin: a twentieth of the volume, of the corners and of their sum.
        vec3 s = a + b + d;
        addTo(square, lost_square, vec4(0.05 * volume * (a * a + b * b + d * d + s * s), 0.0));
        addTo(product, lost_product, vec4(0.05 * volume * (pairs(a) + pairs(b) + pairs(d) + pairs(s)), 0.0));
        low = min(low, vec4(min(a, min(b, d)), 0.0));
        high = max(high, vec4(max(a, max(b, d)), 0.0));
    }
    sums[lane] = sum;
    moments[lane] = moment;
    squares[lane] = square;
    products[lane] = product;
    lows[lane] = low;
    highs[lane] = high;
    barrier();
    for (uint width = ROLLED(GROUP_SIZE / 2u); width > 0u; width >>= 1) {
        if (lane < width) {
            sums[lane] += sums[lane + width];
            moments[lane] += moments[lane + width];
            squares[lane] += squares[lane + width];
            products[lane] += products[lane + width];
            lows[lane] = min(lows[lane], lows[lane + width]);
            highs[lane] = max(highs[lane], highs[lane + width]);
        }
        barrier();
    }
    vec3 cross_moments = products[0].xyz;
    bool in_doubt = abs(sums[0].x) < moments[0].w / 262144.0;
    barrier();
    if (in_doubt) {
        float volume = volumeInPairs(lane, first, last, origin);
        if (lane == 0u) sums[0].x = volume;
    }
    if (lane == 0u && !idle) {
        float volume = sums[0].x;
        vec3 balance = volume != 0.0 ? moments[0].xyz / volume : vec3(0.0);
        vec3 about = squares[0].xyz - volume * balance * balance, across = cross_moments - volume * pairs(balance);
        records[c] = FragmentRecord(sums[0], vec4(origin + balance, 0.0), vec4(about, 0.0), vec4(across, 0.0), vec4(origin + lows[0].xyz, 0.0), vec4(origin + highs[0].xyz, 0.0),
                                    uvec4(FATE_FRAGMENT, c, lead.w, 0u), uvec4(0u));
    }
}
