// A stable radix sort by one workgroup, a digit at a time: every lane holds a run of consecutive entries and counts their digits, a
// prefix sum over (digit, lane) says where each goes. Wants LANES, DIGIT_BITS, a coherent buffer `order` and digitOf declared.
#define DIGITS (1u << DIGIT_BITS)

shared uint tally[DIGITS * LANES];
shared uint row_sums[LANES];

// Sums of all that stands before, in place.
void addUp(uint lane) {
    uint first = lane * DIGITS, sum = 0u;
    for (uint k = 0u; k < ROLLED(DIGITS); k++) sum += tally[first + k];
    row_sums[lane] = sum;
    barrier();
    for (uint step = 1u; step < ROLLED(LANES); step <<= 1) {
        uint left = lane >= step ? row_sums[lane - step] : 0u;
        barrier();
        row_sums[lane] += left;
        barrier();
    }
    uint running = row_sums[lane] - sum;
    for (uint k = 0u; k < ROLLED(DIGITS); k++) {
        uint here = tally[first + k];
        tally[first + k] = running;
        running += here;
    }
    barrier();
}

// n entries of `order`, from one place of it to another.
void sortBy(uint shift, uint n, uint from, uint to) {
    uint lane = gl_LocalInvocationID.x, run = (n + LANES - 1u) / LANES;
    uint first = lane * run, end = min(first + run, n);
    for (uint d = 0u; d < ROLLED(DIGITS); d++) tally[d * LANES + lane] = 0u;
    for (uint k = first; k < end; k++) tally[digitOf(order[from + k], shift) * LANES + lane]++;
    barrier();
    addUp(lane);
    for (uint k = first; k < end; k++) {
        uint entry = order[from + k];
        uint slot = digitOf(entry, shift) * LANES + lane;
        uint at = tally[slot];
        tally[slot] = at + 1u;
        order[to + at] = entry;
    }
    memoryBarrierBuffer();
    barrier();
}
