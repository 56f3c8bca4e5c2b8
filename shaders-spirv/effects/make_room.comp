// If the world has room for few fragments, beside those kept for bodies that have not broken yet, fragments at rest leave it: the
// smallest by octaves of their volume; in an octave those that were made longest ago, by octaves of their age; then in the order of
// slots. One workgroup. It looks at bodies only if room may be short.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/debris.h"
#include "shared/pool.h"
#include "shared/solver.h"

GROUP_KERNEL;
READS(0, uint, counts);
READS(1, BreakableBody, breakable);
READS(2, uint, steps);
READS(3, PoolHeader, pools);
UPDATES(4, DebrisClock, clocks);
UPDATES(5, uint, words);
layout(push_constant) uniform Push {
    uint least_room;  // fragments; room is made if the pool has room for fewer
    uint enough_room; // fragments that the pool shall have room for then
    float rest;       // s, after which a fragment may leave
    uint kept_for_each; // fragments, for each body of the scene that has not broken yet
    uint most_whole;    // such bodies when the world began
};

#include "lib/origin.glsl"

const uint kVolumes = 64u, kAges = 16u, kClasses = kVolumes * kAges;
const int kSmallestExponent = -48; // cubes of 15 um

shared uint members[kClasses];
shared uint sums[GROUP_SIZE];
shared uint kept;       // fragments, for all bodies that have not broken yet
shared uint last_class; // of which some leave; all of those before do
shared uint of_last;    // how many of it

void countKept(uint lane, uint slots) {
    if (lane == 0u) kept = 0u;
    barrier();
    for (uint b = lane; b < slots; b += GROUP_SIZE)
        if (isWhole(b)) atomicAdd(kept, kept_for_each);
    barrier();
}

bool mayLeave(uint b) {
    float rested = clocks[b].offset.w;
    return isFragment(b) && clocks[b].sector.w == int(bornIn(b)) && rested >= rest && rested < float(DEBRIS_OVER);
}

uint classOf(uint b) {
    int exponent;
    frexp(breakable[b].form.x, exponent);
    uint volume = uint(clamp(exponent - kSmallestExponent, 0, int(kVolumes) - 1));
    uint age = max(steps[STEPS_MADE] - bornIn(b), 1u);
    return volume * kAges + (kAges - 1u - min(uint(findMSB(age)), kAges - 1u));
}

void countClasses(uint lane, uint slots) {
    for (uint k = lane; k < kClasses; k += GROUP_SIZE) members[k] = 0u;
    barrier();
    for (uint b = lane; b < slots; b += GROUP_SIZE)
        if (mayLeave(b)) atomicAdd(members[classOf(b)], 1u);
    barrier();
}

void chooseClasses(uint wanted) {
    uint before = 0u, k = 0u;
    for (uint turn = 0u; turn + 1u < kClasses && before + members[k] < wanted; turn++) before += members[k++];
    last_class = k;
    of_last = min(wanted - before, members[k]);
}

void leave(uint b) {
    clocks[b].offset.w = float(DEBRIS_OVER);
    for (uint k = 0u; k < 3u; k++) words[DEBRIS_LIST_ARGUMENTS + k] = 1u; // all say the same
}

// Lanes look at slots that follow each other, so that of the last class the first slots leave.
void letGo(uint lane, uint slots) {
    uint share = (slots + GROUP_SIZE - 1u) / GROUP_SIZE, begin = min(lane * share, slots), end = min(begin + share, slots), own = 0u;
    for (uint b = begin; b < end; b++) own += mayLeave(b) && classOf(b) == last_class ? 1u : 0u;
    sums[lane] = own;
    barrier();
    uint at = 0u;
    for (uint k = 0u; k < ROLLED(GROUP_SIZE); k++) at += k < lane ? sums[k] : 0u;
    for (uint b = begin; b < end; b++) {
        if (!mayLeave(b)) continue;
        uint of = classOf(b);
        if (of < last_class || (of == last_class && at < of_last)) leave(b);
        at += of == last_class ? 1u : 0u;
    }
}

void main() {
    uint lane = gl_LocalInvocationID.x, slots = counts[COUNT_BODIES];
    uint room = pools[POOL_BODIES].capacity - pools[POOL_BODIES].in_use;
    if (room >= least_room + kept_for_each * most_whole || slots == 0u || counts[STATUS_FAILED] != 0u) return;
    countKept(lane, slots);
    if (room >= least_room + kept) return;
    countClasses(lane, slots);
    if (lane == 0u) chooseClasses(min(enough_room + kept - room, uint(MOST_EXPIRING)));
    barrier();
    letGo(lane, slots);
}
