// How much crack each object has got, a workgroup an object: half of the new faces of its fragments, since each cut has two
// sides. Sums in the order of fragments, by lanes that are always as many.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/sum.glsl"
#include "shared/breaking.h"
#include "shared/fragment_record.h"

GROUP_KERNEL;
READS(0, uint, counts);
READS(1, BreakingRecord, breaking);
READS(2, uint, owner_start);
READS(3, uint, order);
READS(4, FragmentRecord, fragments);
WRITES(5, float, cracks); // m2

shared float sums[GROUP_SIZE];

void main() {
    uint k = flatGroup(), lane = gl_LocalInvocationID.x;
    if (k >= counts[COUNT_BREAKING]) return;
    bool any_ = counts[COUNT_FRAGMENTS] > 0u;
    uint first = any_ ? owner_start[k] : 0u, last = any_ ? owner_start[k + 1u] : 0u;
    vec4 sum = vec4(0.0), lost = vec4(0.0);
    for (uint r = first + lane; r < last; r += GROUP_SIZE) {
        vec4 measure = fragments[order[r]].measure;
        addTo(sum, lost, vec4(0.0, measure.y - measure.z, 0.0, 0.0));
    }
    sums[lane] = sum.y;
    barrier();
    if (lane != 0u) return;
    float total = 0.0;
    for (uint j = 0u; j < GROUP_SIZE; j++) total += sums[j];
    float unit = 1.0 / breaking[k].center.w;
    cracks[k] = 0.5 * total * unit * unit;
}
