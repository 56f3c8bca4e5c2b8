// Numbers for the particles that come of this step's event, in the order of its fragments; and the ring goes on: its oldest have
// settled, or make room. One workgroup, whose lanes take fragments that follow each other.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/breaking.h"
#include "shared/dust.h"
#include "shared/fragment_record.h"

GROUP_KERNEL;
READS(0, uint, counts);
READS(1, uint, order);
READS(2, uint, owners); // sorted
READS(3, FragmentRecord, fragments);
READS(4, BreakingRecord, breaking);
READS(5, uvec4, rooms);
UPDATES(6, uint, state);
WRITES(7, uint, offsets); // of a fragment's first particle among all of this event, in that order
layout(push_constant) uniform Push {
    float least_volume;
    uint capacity;
};
#include "lib/particles_of_cell.glsl"
layout(constant_id = FLAT_SIZE_ID) const uint flat_size = GROUP_SIZE;

shared uint sums[GROUP_SIZE];

uint particlesAt(uint r) {
    uint f = order[r];
    bool is_dust = rooms[f][ROOM_BODY] == ROOM_OF_DUST;
    return is_dust ? particlesOfCell(fragments[f].measure.x, breaking[owners[r]].center.w, least_volume) : 0u;
}

uint allot(uint lane) {
    uint fragments_ = counts[COUNT_FRAGMENTS], share = (fragments_ + GROUP_SIZE - 1u) / GROUP_SIZE;
    uint begin = min(lane * share, fragments_), end = min(begin + share, fragments_), own = 0u;
    for (uint r = begin; r < end; r++) own += particlesAt(r);
    sums[lane] = own;
    barrier();
    uint before = 0u, total = 0u;
    for (uint k = 0u; k < ROLLED(GROUP_SIZE); k++) {
        before += k < lane ? sums[k] : 0u;
        total += sums[k];
    }
    for (uint r = begin; r < end; r++) {
        offsets[r] = before;
        before += particlesAt(r);
    }
    return total;
}

void main() {
    uint lane = gl_LocalInvocationID.x, made = allot(lane);
    if (lane != 0u) return;
    uint first = state[DUST_FIRST] + state[DUST_AGED], next = state[DUST_NEXT];
    uint live = next + made - first, over = live - min(live, capacity);
    state[DUST_SETTLED] += state[DUST_AGED];
    state[DUST_AGED] = 0u;
    state[DUST_WAS_FIRST] = first;
    state[DUST_WAS_NEXT] = next;
    state[DUST_OVERWRITTEN] += over;
    state[DUST_FIRST] = first + over;
    state[DUST_NEXT] = next + made;
    uint groups = (live - over + flat_size - 1u) / flat_size;
    state[DUST_ARGUMENTS] = min(groups, 65535u);
    state[DUST_ARGUMENTS + 1u] = (groups + 65534u) / 65535u;
    state[DUST_ARGUMENTS + 2u] = 1u;
}
