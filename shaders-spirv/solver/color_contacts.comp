// Colors for contacts, by one workgroup: contacts of one color share no body that moves. A contact keeps the color that it had;
// new ones take turns: all that wait bid for their bodies, whoever has the best bid on both takes the lowest color that neither
// body has yet (Jones and Plassmann 1993). Bids come from the contacts' places in the list, scrambled, so that neighbors in the
// list do not wait for each other; nothing depends on which lane is first.
//
// What a contact had may have been given away: while a blow kept it from being solved, or while a body of it slept, since what does not
// move has no colors. All that hold one color of one body then take turns anew.
//
// Small islands get a range of their own in the order of contacts, behind those of large ones, and order_islands puts the colors
// in order there. What comes of it is the same: islands share no body that moves.
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
UPDATES(4, uint, body_colors); // four words a body: colors that its contacts have, and those that more than one of them had
UPDATES(5, uint, bids);        // the best for each body, NO_INDEX for none
UPDATES(6, uint, waiting);     // two lists
WRITES(7, uint, contact_slots);
WRITES(8, uint, color_start);  // where each color begins, NO_COLOR as the last, the end, and COLORS_*
WRITES(9, uint, args);
READS(10, uint, islands);          // of a body: the lowest of its island
UPDATES(11, uint, island_contacts); // of an island: how many, then where the next goes; 0 to begin with
WRITES(12, uvec2, island_ranges);  // of each small island: its first contact and the end, in the order of contacts
WRITES(13, uint, listed);          // contacts of small islands, island by island
layout(push_constant) uniform Push { uint capacity, few_contacts; }; // of an island that is set apart
#include "lib/publish.glsl"

const uint kMostRounds = 1024u;
const uint kTurnBudget = 40000u; // of the 65,535 that Mesa's software device allows

shared uint waiting_count[2], color_count[NO_COLOR + 1], cursor[NO_COLOR + 1], ordered;
shared uint colors_used, colorless; // by all contacts, apart or not
shared uint contested;              // whether any color is
shared uint before[LANES];          // contacts without a color, in the order of lanes

void sync() {
    memoryBarrierBuffer();
    barrier();
}

bool moves(uint body) { return solver_bodies[body].velocity.w != 0.0; }
uint bidOf(uint contact) { return contact * 0x9e3779b1u & 0x7fffffffu; }

uvec2 colorsOf(uint body) { return moves(body) ? uvec2(body_colors[4u * body], body_colors[4u * body + 1u]) : uvec2(0u); }
uint wordOf(uint body, uint color) { return 4u * body + (color >> 5); }
uint bitOf(uint color) { return 1u << (color & 31u); }

void takeColor(uint body, uint color) {
    if (moves(body)) atomicOr(body_colors[wordOf(body, color)], bitOf(color));
}

void claimColor(uint body, uint color) {
    uint word = wordOf(body, color), bit = bitOf(color);
    if (!moves(body) || (atomicOr(body_colors[word], bit) & bit) == 0u) return;
    atomicOr(body_colors[word + 2u], bit);
    contested = 1u;
}

bool isContested(uint body, uint color) { return moves(body) && (body_colors[wordOf(body, color) + 2u] & bitOf(color)) != 0u; }

// Nobody else keeps it: all others that had it drop it, too, or there are none.
void dropColor(uint body, uint color) {
    if (moves(body)) atomicAnd(body_colors[wordOf(body, color)], ~bitOf(color));
}

uint lowestFree(uvec2 taken) {
    uvec2 free_ = ~taken;
    return free_.x != 0u ? uint(findLSB(free_.x)) : (free_.y != 0u ? 32u + uint(findLSB(free_.y)) : NO_COLOR);
}

void keepOldColors(uint lane, uint total) {
    for (uint c = lane; c < total; c += LANES) {
        uvec4 ids = memory[contact_pairs[c]].ids;
        if (ids.w < COLORS) {
            claimColor(ids.x, ids.w);
            claimColor(ids.y, ids.w);
        } else waiting[atomicAdd(waiting_count[0], 1u)] = c;
    }
    sync();
}

void dropContested(uint lane, uint total) {
    for (uint c = lane; c < total; c += LANES) {
        uvec4 ids = memory[contact_pairs[c]].ids;
        if (ids.w >= COLORS || !(isContested(ids.x, ids.w) || isContested(ids.y, ids.w))) continue;
        dropColor(ids.x, ids.w);
        dropColor(ids.y, ids.w);
        waiting[atomicAdd(waiting_count[0], 1u)] = c;
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

#include "lib/order_by_island.glsl"

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

// Where contacts go within a color is all the same. Without one they are solved one after the other, so they stand in their order: each
// lane counts those of a part of the list.
void placeColored(uint lane, uint total) {
    for (uint c = lane; c < total; c += LANES) {
        uint color = colorOf(c);
        if (color != NO_COLOR && !isApart(c)) contact_slots[c] = atomicAdd(cursor[color], 1u);
    }
}

bool lacksColor(uint c) { return colorOf(c) == NO_COLOR && !isApart(c); }

void placeColorless(uint lane, uint total) {
    uint part = (total + LANES - 1u) / LANES, first = min(lane * part, total), last = min(first + part, total), count = 0u;
    for (uint c = first; c < last; c++) count += lacksColor(c) ? 1u : 0u;
    before[lane] = count;
    sync();
    uint slot = cursor[NO_COLOR];
    for (uint k = 0u; k < lane; k++) slot += before[k];
    for (uint c = first; c < last; c++)
        if (lacksColor(c)) contact_slots[c] = slot++;
}

void publish(uint lane, uint total, uint apart) {
    bool many = ordered > FEW_CONTACTS;
    if (lane < WIDE_COLORS) publishCount(COUNT_FIRST_COLOR + lane, many ? color_count[lane] : 0u, capacity);
    if (lane == WIDE_COLORS) publishCount(COUNT_SWIFT, counts[COUNT_SWIFT] != 0u ? total : 0u, capacity);
    if (lane == WIDE_COLORS + 1u) publishCount(COUNT_SOLVED_APART, apart + (ordered != 0u ? 1u : 0u), NO_INDEX);
    if (lane == WIDE_COLORS + 2u) publishCount(COUNT_BY_COLOR, ordered != 0u ? 1u : 0u, NO_INDEX);
    if (lane == WIDE_COLORS + 3u) publishCount(COUNT_UNFINISHED, 0u, NO_INDEX);
    if (lane == 0u) {
        color_start[COLORS_USED] = colors_used;
        color_start[COLORS_LACKED] = colorless;
        color_start[ISLANDS_APART] = apart;
    }
}

void main() {
    uint lane = gl_LocalInvocationID.x, total = counts[COUNT_CONTACTS];
    if (lane < 2u) waiting_count[lane] = 0u;
    if (lane == 0u) contested = 0u;
    for (uint k = lane; k <= NO_COLOR; k += LANES) color_count[k] = 0u;
    sync();
    keepOldColors(lane, total);
    dropContested(lane, contested != 0u ? total : 0u);
    colorNew(lane);
    countIslands(lane, total);
    countColors(lane, total);
    placeColored(lane, total);
    placeColorless(lane, color_count[NO_COLOR] != 0u ? total : 0u);
    publish(lane, total, setApart(lane, total));
}
