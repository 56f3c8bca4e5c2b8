// Prefix sums over the lanes of a workgroup. Wants LANES and sync() declared.
#define SUM_STEPS (LANES > 256 ? 5 : (LANES > 64 ? 4 : (LANES > 16 ? 3 : 2))) /* powers of four up to LANES */

shared uint lane_sum[LANES];

// Sum over the lanes before this one; lane_sum holds the sums with this one.
uint sumBefore(uint lane, uint value) {
    lane_sum[lane] = value;
    sync();
    // Four-way: half the steps of the usual doubling, each with three terms.
    [[unroll]] for (uint k = 0u; k < SUM_STEPS; k++) {
        uint step = 1u << (2u * k);
        uint left = lane >= step ? lane_sum[lane - step] : 0u;
        left += lane >= 2u * step ? lane_sum[lane - 2u * step] : 0u;
        left += lane >= 3u * step ? lane_sum[lane - 3u * step] : 0u;
        sync();
        lane_sum[lane] += left;
        sync();
    }
    return lane_sum[lane] - value;
}
