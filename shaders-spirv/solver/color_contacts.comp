// Colors for contacts, by one workgroup: contacts of one color share no body that moves. A contact keeps the color that it had;
// new ones take turns: all that wait bid for their bodies, whoever has the best bid on both takes the lowest color that neither
// body has yet (Jones and Plassmann 1993). Bids come from the contacts' places in the list, scrambled, so that neighbors in the
// list do not wait for each other; nothing depends on which lane is first.
//
// Where islands are known (ISLANDS), small ones get a range of their own in the order of contacts, behind those of large ones,
// and order_islands puts the colors in order there. What comes of it is the same: islands share no body that moves.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "lib/kernel.glsl"
#include "shared/solver.h"

#define LANES GROUP_SIZE
GROUP_KERNEL;
UPDATES(0, uint, counts);
READS(1, uint, contact_pairs);
UPDATES(2, ContactMemory, memory);
READS(3, SolverBody, solver_bodies);
UPDATES(4, uint, body_colors); // two words a body: colors that its contacts have
UPDATES(5, uint, bids);        // the best for each body, NO_INDEX for none
UPDATES(6, uint, waiting);     // two lists
WRITES(7, uint, contact_slots);
WRITES(8, uint, color_start);  // where each color begins, NO_COLOR as the last, the end, and COLORS_*
WRITES(9, uint, args);
#ifdef ISLANDS
READS(10, uint, islands);          // of a body: the lowest of its island
UPDATES(11, uint, island_contacts); // of an island: how many, then where the next goes; 0 to begin with
WRITES(12, uvec2, island_ranges);  // of each small island: its first contact and the end, in the order of contacts
WRITES(13, uint, listed);          // contacts of small islands, island by island
#endif
layout(push_constant) uniform Push { uint capacity; };
#include "lib/publish.glsl"

const uint kMostRounds = 1024u;
const uint kTurnBudget = 40000u; // of the 65,535 that Mesa's software device allows

shared uint waiting_count[2], color_count[NO_COLOR + 1], cursor[NO_COLOR + 1], ordered;
shared uint colors_used, colorless; // by all contacts, apart or not

void sync() {
    memoryBarrierBuffer();
    barrier();
}

bool moves(uint body) { return solver_bodies[body].velocity.w != 0.0; }
uint bidOf(uint contact) { return contact * 0x9e3779b1u & 0x7fffffffu; }

uvec2 colorsOf(uint body) { return moves(body) ? uvec2(body_colors[2u * body], body_colors[2u * body + 1u]) : uvec2(0u); }

void takeColor(uint body, uint color) {
    if (moves(body)) atomicOr(body_colors[2u * body + (color >> 5)], 1u << (color & 31u));
}

uint lowestFree(uvec2 taken) {
    uvec2 free_ = ~taken;
    return free_.x != 0u ? uint(findLSB(free_.x)) : (free_.y != 0u ? 32u + uint(findLSB(free_.y)) : NO_COLOR);
}

void keepOldColors(uint lane, uint total) {
    for (uint c = lane; c < total; c += LANES) {
        uvec4 ids = memory[contact_pairs[c]].ids;
        if (ids.w < COLORS) {
            takeColor(ids.x, ids.w);
            takeColor(ids.y, ids.w);
        } else waiting[atomicAdd(waiting_count[0], 1u)] = c;
    }
    sync();
}

void bid(uint lane, uint from, uint count) {
    for (uint k = lane; k < count; k += LANES) {
        uint c = waiting[from + k];
        uvec4 ids = memory[contact_pairs[c]].ids;
        if (moves(ids.x)) atomicMin(bids[ids.x], bidOf(c));
        if (moves(ids.y)) atomicMin(bids[ids.y], bidOf(c));
    }
    sync();
}

// Those that won take a color, the others wait for the next round, in the other list.
void award(uint lane, uint from, uint to, uint count, uint next) {
    for (uint k = lane; k < count; k += LANES) {
        uint c = waiting[from + k], mine = bidOf(c);
        uvec4 ids = memory[contact_pairs[c]].ids;
        bool won = (!moves(ids.x) || bids[ids.x] == mine) && (!moves(ids.y) || bids[ids.y] == mine);
        if (won) {
            uint color = lowestFree(colorsOf(ids.x) | colorsOf(ids.y));
            memory[contact_pairs[c]].ids.w = color;
            if (color < COLORS) {
                takeColor(ids.x, color);
                takeColor(ids.y, color);
            }
        } else waiting[to + atomicAdd(waiting_count[next], 1u)] = c;
    }
    sync();
}

void withdraw(uint lane, uint from, uint count) {
    for (uint k = lane; k < count; k += LANES) {
        uvec4 ids = memory[contact_pairs[waiting[from + k]]].ids;
        bids[ids.x] = NO_INDEX;
        bids[ids.y] = NO_INDEX;
    }
    sync();
}

void colorNew(uint lane) {
    uint turns = 0u;
    for (uint round = 0u; round < kMostRounds; round++) {
        uint now = round & 1u, next = 1u - now, from = now * capacity, to = next * capacity, count = waiting_count[now];
        if (count == 0u) break;
        if (lane == 0u) waiting_count[next] = 0u;
        sync();
        turns += 3u * (count / LANES + 1u);
        if (turns > kTurnBudget) {
            // Left without a color, which costs time and nothing else.
            for (uint k = lane; k < count; k += LANES) memory[contact_pairs[waiting[from + k]]].ids.w = NO_COLOR;
            sync();
            break;
        }
        bid(lane, from, count);
        award(lane, from, to, count, next);
        withdraw(lane, from, count);
    }
}

uint colorOf(uint c) { return min(memory[contact_pairs[c]].ids.w, NO_COLOR); }

#ifdef ISLANDS
#include "lib/order_by_island.glsl"
#else
bool isApart(uint c) { return false; }
#endif

// Of all that are not set apart.
void countColors(uint lane, uint total) {
    for (uint c = lane; c < total; c += LANES)
        if (!isApart(c)) atomicAdd(color_count[colorOf(c)], 1u);
    sync();
    if (lane == 0u) {
        uint sum = 0u;
        colors_used = 0u;
        for (uint k = 0u; k <= NO_COLOR; k++) {
            if (color_count[k] != 0u && k < NO_COLOR) colors_used = k + 1u;
            color_start[k] = sum;
            cursor[k] = sum;
            sum += color_count[k];
        }
        color_start[NO_COLOR + 1u] = sum;
        color_start[COLORS_ORDERED] = colors_used;
        ordered = sum;
        colorless = color_count[NO_COLOR];
    }
    sync();
}

void publish(uint lane, uint total, uint apart) {
    bool many = ordered > FEW_CONTACTS;
    if (lane < WIDE_COLORS) publishCount(COUNT_FIRST_COLOR + lane, many ? color_count[lane] : 0u, capacity);
    if (lane == WIDE_COLORS) publishCount(COUNT_SWIFT, counts[COUNT_SWIFT] != 0u ? total : 0u, capacity);
    if (lane == WIDE_COLORS + 1u) publishCount(COUNT_SOLVED_APART, apart + (ordered != 0u ? 1u : 0u), NO_INDEX);
    if (lane == 0u) {
        color_start[COLORS_USED] = colors_used;
        color_start[COLORS_LACKED] = colorless;
        color_start[ISLANDS_APART] = apart;
    }
}

void main() {
    uint lane = gl_LocalInvocationID.x, total = counts[COUNT_CONTACTS], apart = 0u;
    if (lane < 2u) waiting_count[lane] = 0u;
    for (uint k = lane; k <= NO_COLOR; k += LANES) color_count[k] = 0u;
    sync();
    keepOldColors(lane, total);
    colorNew(lane);
#ifdef ISLANDS
    countIslands(lane, total);
#endif
    countColors(lane, total);
    for (uint c = lane; c < total; c += LANES)
        if (!isApart(c)) contact_slots[c] = atomicAdd(cursor[colorOf(c)], 1u);
#ifdef ISLANDS
    apart = setApart(lane, total);
#endif
    publish(lane, total, apart);
}
