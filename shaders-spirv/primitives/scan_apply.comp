// Second half of an exclusive prefix sum: offsets[k] = values[0] + ... + values[k - 1], and the total at offsets[n].
// Reduce-then-scan, not decoupled look-back: no workgroup ever waits for another (no forward progress is promised).
// The last block publishes the totals, so that what follows can be dispatched without the host.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/scan_value.glsl"

GROUP_KERNEL;
UPDATES(0, uint, counts);
READS(1, Value, values);
READS(2, Value, sums);
WRITES(3, Value, offsets);
WRITES(4, uint, args);
layout(push_constant) uniform Push {
    uint length;
    uint length_count;
    uint pad0;
    uint pad1;
    uvec4 published; // the counts that the totals become, NO_INDEX for none
    uvec4 capacity;
};
#include "lib/publish.glsl"

shared Value partial[GROUP_SIZE];

Value sumOfEarlierBlocks(uint block, uint lane) {
    Value sum = Value(0);
    for (uint b = lane; b < block; b += GROUP_SIZE) sum += sums[b];
    partial[lane] = sum;
    barrier();
    for (uint width = ROLLED(GROUP_SIZE / 2u); width > 0u; width >>= 1) {
        if (lane < width) partial[lane] += partial[lane + width];
        barrier();
    }
    Value total = partial[0];
    barrier();
    return total;
}

void main() {
    uint n = length_count == NO_INDEX ? length : counts[length_count];
    // What is added up then was never written, and would ask for pools of any size.
    bool failed = counts[STATUS_FAILED] != 0u;
    uint lane = gl_LocalInvocationID.x, block = flatGroup();
    uint first = block * SCAN_BLOCK + lane * (SCAN_BLOCK / GROUP_SIZE);
    Value before = sumOfEarlierBlocks(block, lane);
    Value sum = Value(0);
    for (uint k = 0u; k < ROLLED(SCAN_BLOCK / GROUP_SIZE); k++) {
        sum += first + k < n ? values[min(first + k, n - 1u)] : Value(0);
    }
    partial[lane] = sum;
    barrier();
    for (uint step = 1u; step < ROLLED(GROUP_SIZE); step <<= 1) {
        Value left = lane >= step ? partial[lane - step] : Value(0);
        barrier();
        partial[lane] += left;
        barrier();
    }
    Value running = before + partial[lane] - sum;
    for (uint k = 0u; k < ROLLED(SCAN_BLOCK / GROUP_SIZE); k++) {
        if (first + k <= n) offsets[first + k] = running;
        running += first + k < n ? values[min(first + k, n - 1u)] : Value(0);
        if (first + k + 1u == n) {
            offsets[n] = running;
#if CHANNELS == 4
            for (uint c = 0u; c < ROLLED(4); c++) {
                if (published[c] != NO_INDEX) publishCount(published[c], failed ? 0u : running[c], capacity[c]);
            }
#else
            if (published.x != NO_INDEX) publishCount(published.x, failed ? 0u : running, capacity.x);
#endif
        }
    }
}
