// Small islands, a workgroup each: all substeps of a step, as many as the island needs (lib/pace.glsl). A substep begins with
// gravity and the impulses of the one before, goes through all colors with push, moves the bodies, and goes through all colors
// again without. Few lanes where they run in turn: a color seldom has work for many.
//
// Where bodies bounce (BOUNCE) they meet after each move (lib/meet_contact.glsl).
//
// Where a lane may take few turns, a step takes several dispatches (ISLAND_PARTS), each of which goes on where the last one ended.
// The others idle unless the first one finds an island that it cannot finish (COUNT_UNFINISHED).
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "lib/kernel.glsl"
#include "lib/component.glsl"
#include "lib/effect.glsl"
#include "shared/body.h"
#include "shared/solver.h"

#ifndef LANES
#define LANES 8u
#endif

layout(local_size_x = LANES) in;
CONTACTS_EFFECT;
READS(0, uint, counts);
READS(1, uint, color_start);
READS(2, uvec2, island_ranges);
READS(3, uint, color_ends);
READS(4, uint, adjacency_start);
READS(5, uint, adjacency); // a contact << 1, | 1 where the body is its B
READS(6, uint, steps);
READS(7, BodyShape, shapes);
UPDATES(8, SolverContact, solver_contacts);
UPDATES(9, SolverBody, solver_bodies);
UPDATES(10, BodyState, bodies);
UPDATES(11, vec4, spins);
UPDATES(12, uint, heights);
// Each island has here how many bodies move, substeps made in this step, and those bodies, at most one more than contacts. Its words begin
// at four times its first contact: islands have no order, and their ranges have another.
UPDATES(13, uint, members);
UPDATES(14, uint, args);    // of dispatches; those of COUNT_UNFINISHED hold no workgroups when a step begins
layout(push_constant) uniform Push { PacePush push_; };

vec4 gravity, soft, stiff; // as in SolverPush, for this island
uint with_push;
bool rubs_in_push; // if contacts carry loads
bool keeps_first;
float wholeStep() { return push_.gravity.w; }
#include "lib/solve_contact.glsl"
#include "lib/push_body.glsl"
#include "lib/move_body.glsl"
#include "lib/softness.glsl"
#include "lib/island_heights.glsl"
#include "lib/pace.glsl"

shared uint most_sides, leaning, facing, of_cells; // contacts that lean; those of them in which faces meet in four points; others of cells
#ifdef BOUNCE
shared uint lively, met;
#include "lib/meet_contact.glsl"
#endif

void sync() {
    memoryBarrierBuffer();
    barrier();
}

uint turns_left = 20000u; // for impacts and blows, of those that a lane may take (lib/pace.glsl)
#include "lib/struck_bodies.glsl"

// A body is listed by the first of its contacts.
void listMember(uint body, uint c, uint first) {
    uint side = adjacency_start[body];
    if (solver_bodies[body].velocity.w == 0.0 || adjacency[side] >> 1 != c) return;
    members[first + atomicAdd(member_count, 1u)] = body;
    atomicMax(most_sides, adjacency_start[body + 1u] - side);
}

bool hasCells(uint body) { return shapes[body].pieces.y > 1u; }

void noteLeaning(uvec4 ids) {
    atomicAdd(leaning, 1u);
    if (ids.z == uint(MANIFOLD_POINTS)) atomicAdd(facing, 1u);
    else if (hasCells(ids.x) || hasCells(ids.y)) atomicAdd(of_cells, 1u);
}

void listMembers(uint lane, uvec2 range, uint first) {
    for (uint c = range.x + lane; c < range.y; c += LANES) {
        uvec4 ids = solver_contacts[c].ids;
        listMember(ids.x, c, first);
        listMember(ids.y, c, first);
        bool leans = mayLean(c);
        solver_contacts[c].pace.w = leans ? 1u : 0u;
        if (leans) noteLeaning(ids);
    }
}

// Impulses are those of a substep: shorter ones have less.
void takePace(uint lane, uvec2 range, uint pace, bool carries) {
    float share = float(push_.substeps) / float(pace);
    for (uint c = range.x + lane; c < range.y; c += LANES) {
        solver_contacts[c].pace = uvec4(solver_contacts[c].pace.x, pace, carries ? 1u : 0u, isUneven(solver_contacts[c].ids.xy) ? 1u : 0u);
        solver_contacts[c].loads *= carries ? share : 0.0;
        if (kFriction != 0u) solver_contacts[c].rub.xyz *= share;
        for (uint k = 0u; k < MANIFOLD_POINTS && k < solver_contacts[c].ids.z; k++) solver_contacts[c].points[k].pulse.x *= share;
    }
}

void setSubstep(uint pace) {
    float h = push_.gravity.w / float(pace), hertz = min(push_.hertz * float(pace) / float(push_.substeps), STIFFEST / h);
    gravity = vec4(push_.gravity.xyz, h);
    soft = vec4(softnessOf(hertz, push_.damping, h), 0.0);
    stiff = vec4(softnessOf(2.0 * hertz, 0.5 * push_.damping, h), push_.least_bounce);
}

#ifdef BOUNCE
const uint kMostMeetings = 64u;

bool comesIn(uint c) {
    bool comes = false;
    for (uint k = 0u; k < MANIFOLD_POINTS && k < solver_contacts[c].ids.z; k++)
        comes = comes || solver_contacts[c].points[k].pulse.z < -stiff.w;
    return comes && solver_contacts[c].tangent.w > 0.0;
}

// Only islands that something comes into at speed look for impacts.
void findImpacts(uint lane, uvec2 range) {
    if (lane == 0u) lively = 0u;
    barrier();
    for (uint c = range.x + lane; c < range.y; c += LANES)
        if (comesIn(c)) lively = 1u;
    barrier();
}

// Contacts take turns with the speeds that bodies have then, until none comes in any more. So a blow travels through a row of bodies
// that touch, as through Newton's cradle.
void meetAll(uint lane, uvec2 range, bool now) {
    uint rounds = lively != 0u && now ? kMostMeetings : 0u;
    for (uint round = 0u; round < rounds && turns_left != 0u; round++) {
        if (lane == 0u) met = 0u;
        sync();
        uint at = rounds != 0u ? range.x : range.y, rows = 0u, walked = 0u;
        for (uint color = 0u; color < kMostContacts && at < range.y; color++) {
            uint end = color_ends[at];
            for (uint c = at + lane; c < end; c += LANES) meetContact(c);
            sync();
            rows += (end - at + kLanes - 1u) / kLanes;
            walked += 2u;
            at = end;
        }
        uint sweeps = met;
        barrier();
        turns_left -= min(turns_left, walked + (sweeps + 8u) * rows);
        rounds = sweeps != 0u ? rounds : 0u;
    }
}
#endif

void sweep(uint lane, uvec2 range) {
    uint at = range.x;
    for (uint color = 0u; color < kMostContacts && at < range.y; color++) {
        uint end = color_ends[at];
        for (uint c = at + lane; c < end; c += LANES) solveContact(c);
        sync();
        at = end;
    }
}

// Colors are walked through twice for each iteration. Bodies get their push before the first sweep and move before the middle one. It
// costs a sweep as much as a few contacts to see that it does neither. Impacts come after each move, before a sweep holds back what is
// about to meet; and, in a pass of their own, before the first sweep of a step.
//
// `settles`: an island begins to touch. Where it does so at rest, friction needs several sweeps to find what it has to hold. What has
// slipped by then would slide on for long where friction hardly holds it.
void solveSubstep(uint lane, uvec2 range, uint first, uint substep, uint turns, bool settles, vec3 falls) {
    uint pushes = push_.iterations, relaxes = push_.iterations, more = 0u;
    bool strikes = false, watches = false;
    for (uint pass = substep == 0u ? 0u : 1u; pass <= pushes + relaxes; pass++) {
        bool begins = pass == 1u, moves = pass == pushes + 1u, is_first = begins || moves;
        with_push = pass <= pushes ? (begins ? PUSH_FIRST : PUSH_AGAIN) : (moves ? RELAX_FIRST : RELAX_AGAIN);
        for (uint k = lane; k < (begins ? member_count : 0u); k += LANES) pushBody(members[first + k], falls);
        for (uint k = lane; k < (moves ? member_count : 0u); k += LANES) moveBody(members[first + k], gravity.w);
        watches = watches && more != 0u && !is_first;
        watch(lane, watches ? range : range.yy);
        if (lane == 0u && is_first) hit = struck = 0u;
        sync();
#ifdef BOUNCE
        meetAll(lane, range, moves || pass == 0u);
#endif
        sweep(lane, pass != 0u ? range : range.yy);
        more -= watches ? 0u : min(more, 1u);
        for (uint k = 0u; k < (watches ? 1u : 0u); k++) {
            uint skipped = isDone(lane, range, more % 3u == 1u && more > 1u) ? more - 1u : 0u;
            pushes -= pass <= pushes ? skipped : 0u;
            relaxes -= pass > pushes ? skipped : 0u;
            more -= skipped + 1u;
        }
        bool is_struck = anyStruck(lane, range, is_first, 0x80000000u | 2u * substep | (moves ? 1u : 0u));
        uint found = moreSweeps(is_struck, moves && settles && !was_hit, turns);
        watches = watches || (is_struck && sweeps_on);
        strikes = strikes || watches;
        pushes += begins ? found : 0u;
        relaxes += moves ? found : 0u;
        more += found;
    }
    uint end = strikes ? range.y : range.x;
    for (uint c = range.x + lane; c < end; c += LANES) forgetBlow(c);
    sync(); // bodies are pushed by what contacts keep
}

// The other dispatches of this step have as many workgroups as this one.
void callForMore() {
    uint from = 9u * COUNT_SOLVED_APART + 6u, to = 9u * COUNT_UNFINISHED + 6u;
    for (uint k = 0u; k < 3u; k++) atomicMax(args[to + k], args[from + k]);
}

void main() {
    uint lane = gl_LocalInvocationID.x, group = flatGroup();
    if (group >= color_start[ISLANDS_APART] || counts[STATUS_FAILED] != 0u) return;
    uvec2 range = island_ranges[group];
    uint first = 4u * range.x + 2u; // the number of bodies and of substeps made stand before
    bool begins = push_.part == 0u;
    if (!begins && members[first - 1u] >= solver_contacts[range.x].pace.y) return;
    if (lane == 0u) {
        member_count = begins ? 0u : members[first - 2u];
        most_sides = leaning = facing = of_cells = 0u;
    }
    barrier();
    uvec2 to_begin = begins ? range : range.xx;
    listMembers(lane, to_begin, first);
    sync();
    uint height = heightOfIsland(lane, to_begin), turns = turnsOf(range, member_count, most_sides);
    bool is_heap = isHeap(leaning, member_count);
    may_hurry = !is_heap || nearlyAll(facing, leaning);
    uint most = affordable(is_heap, turns);
    bool carries;
    bool is_ordered = nearlyAll(facing + of_cells, leaning);
    uint chosen = paceOf(lane, to_begin, height, is_heap, is_ordered, most, carries);
    uint pace = begins ? chosen : solver_contacts[range.x].pace.y;
    takePace(lane, to_begin, pace, carries);
    sync();
    setSubstep(pace);
    rubs_in_push = solver_contacts[range.x].pace.z != 0u;
    sweeps_on = needsSweeps(lane, range);
    keeps_first = sweeps_on;
    weighBodies(lane, sweeps_on ? range : range.yy);
#ifdef BOUNCE
    findImpacts(lane, range);
#endif
    uint made = begins ? 0u : members[first - 1u], at_once = push_.parts > 1u ? substepsAtOnce(turns) : pace;
    float lag = steps[STEPS_MADE] == 0u ? 0.5 * push_.gravity.w / float(push_.substeps) : 0.0;
    for (uint substep = made; substep < min(made + at_once, pace); substep++)
        solveSubstep(lane, range, first, substep, turns, begins && substep == 0u && last_pace == 0u && !rubs_in_push,
                     (gravity.w + (substep == 0u ? lag : 0.0)) * gravity.xyz);
    if (lane != 0u) return;
    members[first - 2u] = member_count;
    members[first - 1u] = min(made + at_once, pace);
    if (begins && at_once < pace) callForMore();
}
