// Opens the broad phase, and where there are few boxes is all of it: one workgroup holds each against each, a lane a row. A row's
// partners are kept as bits until it is known where they go.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/box.glsl"

layout(local_size_x = FEW_BOXES) in;
UPDATES(0, uint, counts);
WRITES(1, uint, args);
READS(2, uvec4, box_low);
READS(3, uvec4, box_high);
WRITES(4, uvec2, pairs);
layout(push_constant) uniform Push {
    uint box_capacity;
    uint pair_capacity;
};
#include "lib/publish.glsl"
#define ROW_WORDS (FEW_BOXES / 32)

shared Box boxes[FEW_BOXES];
shared uint rows[ROW_WORDS * FEW_BOXES];
shared uint sums[FEW_BOXES];

bool arePaired(Box a, Box b) {
    return meet(a, b) && a.low.w != b.low.w && (a.high.w & b.high.w & BOX_STATIC) == 0u;
}

// How many boxes behind its own a row meets.
uint findRow(uint a, uint n) {
    Box box = boxes[a];
    uint found = 0u;
    for (uint w = 0u; w < ROLLED(ROW_WORDS); w++) {
        uint bits = 0u, end = min(32u * w + 32u, n);
        for (uint b = max(32u * w, a + 1u); b < end; b++) bits |= arePaired(box, boxes[b]) ? 1u << (b & 31u) : 0u;
        rows[w * FEW_BOXES + a] = bits;
        found += bitCount(bits);
    }
    return found;
}

void writeRow(uint a, uint at) {
    for (uint w = 0u; w < ROLLED(ROW_WORDS); w++) {
        uint bits = rows[w * FEW_BOXES + a];
        for (uint turn = 0u; turn < 32u && bits != 0u; turn++) {
            if (at < pair_capacity) pairs[at] = uvec2(a, 32u * w + findLSB(bits));
            bits &= bits - 1u;
            at++;
        }
    }
}

// Sums up to and with each lane's own.
void addUp(uint lane) {
    barrier();
    for (uint step = 1u; step < ROLLED(FEW_BOXES); step <<= 1) {
        uint left = lane >= step ? sums[lane - step] : 0u;
        barrier();
        sums[lane] += left;
        barrier();
    }
}

void main() {
    uint lane = gl_LocalInvocationID.x, given = counts[COUNT_BOXES];
    bool few = given <= FEW_BOXES && given <= box_capacity && counts[STATUS_FAILED] == 0u;
    uint n = few ? given : 0u;
    boxes[lane] = kNoBox;
    if (lane < n) boxes[lane] = checkedBox(box_low[lane], box_high[lane]);
    barrier();
    uint found = findRow(lane, n);
    sums[lane] = found;
    addUp(lane);
    writeRow(lane, sums[lane] - found);
    if (lane != 0u) return;
    counts[COUNT_FOUND_PAIRS] = 0u;
    counts[COUNT_LONG_LISTS] = 0u;
    publishCount(COUNT_BOXES, given, box_capacity);
    publishCount(COUNT_TREE_BOXES, few ? 0u : given, NO_INDEX);
    publishCount(COUNT_TREE_PAIRS, 0u, NO_INDEX);
    publishCount(COUNT_BOX_PAIRS, sums[FEW_BOXES - 1u], pair_capacity);
}
