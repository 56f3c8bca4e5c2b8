// Fragments become bodies, a lane a fragment: what each weighs, its principal axes, where it is and how it moves, which is as
// the body moved there that it was a part of, and how strong it is.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/breaking_laws.glsl"
#include "lib/half_edge.glsl"
#include "lib/principal_axes.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/collider.h"
#include "shared/fragment_record.h"
#include "shared/solver.h"
#include "lib/sector.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, FragmentRecord, fragments);
READS(2, ivec4, sites);
READS(3, ColliderRecord, colliders);
READS(4, vec4, collider_vertices);
READS(5, BreakingRecord, breaking);
READS(6, BrokenBody, broken);
READS(7, uvec4, rooms);
READS(8, MaterialCard, cards);
UPDATES(9, uint, steps);
WRITES(10, uint, adopted); // by object
UPDATES(11, BodyState, bodies);
UPDATES(12, BodyShape, shapes);
UPDATES(13, BreakableBody, breakable);
UPDATES(14, Birth, births);
layout(push_constant) uniform Push {
    uint seed_low;
    uint seed_high;
    float hold; // s, for how long no blow breaks it
    float duration; // of a step
};
#include "lib/origin.glsl"
#include "lib/whose_fragment.glsl"

const float kLeastVolume = 1e-24; // of a grid's half edge, cubed: some steps of the grid

struct Weighed {
    float volume, mass;
    vec3 moments; // of inertia
    vec4 axes;    // from the principal axes to the frame of the vertices
    vec3 balance; // in that frame
};

// Of the hull along the axes, units of half a grid's edge.
vec3 extentOf(ColliderRecord collider, vec4 axes) {
    vec3 low = vec3(1e30), high = vec3(-1e30);
    for (uint v = 0u; v < min(collider.range.w, uint(COLLIDER_CORNERS)); v++) {
        vec3 p = turned(turnBack(axes), collider_vertices[collider.range.z + v].xyz);
        low = min(low, p);
        high = max(high, p);
    }
    return max(high - low, vec3(0.0));
}

Weighed weighed(uint f, float density, float unit) {
    FragmentRecord r = fragments[f];
    float volume = max(r.measure.x, kLeastVolume);
    float size = max(max(max(r.squares.x, r.squares.y), r.squares.z) / volume, 1e-16);
    Spread spread = Spread(r.squares.xyz / volume / size, r.products.zyx / volume / size);
    vec4 axes = principalTurn(spread);
    vec3 along = soundMoments(size * momentsAlong(spread, axes), extentOf(colliders[f], axes));
    float cubic = volume * unit * unit * unit, mass = density * cubic;
    return Weighed(cubic, mass, mass * unit * unit * (along.yzx + along.zxy), axes, r.balance.xyz * unit);
}

// Of the world's body it was a part of, as it is when the step ends.
BodyState stateOf(Weighed w, BodyState parent, BreakableBody whole, vec3 center) {
    vec3 way = turned(parent.turn, turned(whole.turn, (center - whole.balance.xyz) + w.balance));
    vec3 offset = parent.offset.xyz + way;
    ivec3 sectors = sectorsIn(offset);
    vec4 turn = normalize(turnAfter(turnAfter(parent.turn, whole.turn), w.axes));
    vec3 momentum = turned(turn, w.moments * turned(turnBack(turn), parent.spin.xyz));
    return BodyState(ivec4(parent.sector.xyz + sectors, parent.sector.w & ~(BODY_ASLEEP | BODY_HANGS | BODY_HELD | BODY_ROUND | BODY_BORNE)),
                     vec4(offsetWithin(offset, sectors), 1.0 / w.mass), turn,
                     vec4(parent.velocity.xyz + cross(parent.spin.xyz, way), 0.0), vec4(parent.spin.xyz, 0.0),
                     vec4(momentum, 0.0));
}

// Its pieces, thickness and reach are those of its hull, which another kernel makes.
void setInertia(uint slot, Weighed w, BodyShape parent) {
    shapes[slot].inverse_inertia[0] = vec4(1.0 / w.moments.x, 0.0, 0.0, parent.inverse_inertia[0].w);
    shapes[slot].inverse_inertia[1] = vec4(0.0, 1.0 / w.moments.y, 0.0, parent.inverse_inertia[1].w);
    shapes[slot].inverse_inertia[2].xyz = vec3(0.0, 0.0, 1.0 / w.moments.z);
}

// By where its cell was, not by when it broke or what else did in that step: those hang on how long steps are.
float strengthFor(uint f, uint parent, Weighed w, uint material) {
    ivec3 site = inTile(sites[fragments[f].fate.z].xyz);
    uint number = mixed(mixed(parent) ^ bornIn(parent));
    for (uint axis = 0u; axis < 3u; axis++) number = mixed(number + uint(site[axis]));
    return strengthOf(cards[material], w.volume, chanceOf(seed_low, seed_high, number));
}

// Of its surface only how large it is: bounds are known once it is copied.
void setBreakable(uint slot, uint f, Weighed w, uint parent, float unit) {
    FragmentRecord r = fragments[f];
    uint material = breakable[parent].surface.w, earlier = r.fate.w;
    uvec3 triangles = uvec3(rooms[f][ROOM_TRIANGLES], r.range.z - earlier, earlier + r.range.w);
    float until = float(steps[STEPS_MADE]) * duration + hold;
    breakable[slot].surface = uvec4(3u * triangles, material);
    breakable[slot].form = vec4(w.volume, r.measure.y * unit * unit, strengthFor(f, parent, w, material), until);
    bool again = breakable[parent].balance.w > 0.0;
    breakable[slot].low.w = again ? breakable[parent].low.w : float(parent);
    breakable[slot].balance = vec4(w.balance, float(steps[STEPS_MADE]));
    breakable[slot].high.w = breakable[parent].high.w;
    breakable[slot].turn = turnBack(w.axes);
}

void setBirth(uint slot, uint f, uint object, float unit) {
    uint parent = broken[object].ids.x;
    BreakableBody whole = breakable[parent];
    vec3 site = vec3(inTile(sites[fragments[f].fate.z].xyz) - ivec3(1 << 23)) / kHalfEdge * unit + breaking[object].center.xyz;
    births[slot].site = vec4(turned(bodies[parent].turn, turned(whole.turn, site - whole.balance.xyz)), 0.0);
    births[slot].turn = bodies[slot].turn;
    uint generation = (whole.balance.w > 0.0 ? births[parent].of.z : 0u) + 1u;
    births[slot].of = uvec4(parent, steps[STEPS_MADE], generation, 0u);
}

void main() {
    uint f = flatIndex();
    if (f >= counts[COUNT_FRAGMENTS] || counts[STATUS_FAILED] != 0u) return;
    uint slot = rooms[f][ROOM_BODY];
    if (slot == NO_INDEX) return;
    uint object = objectOfFragment(f), parent = broken[object].ids.x;
    adopted[object] = 1u; // all of an object say the same
    if (slot == ROOM_OF_DUST) return;
    BodyState body = bodies[parent];
    BreakableBody whole = breakable[parent];
    float unit = inversePower(breaking[object].center.w);
    // What did not move weighed nothing: its fragments do, as their material does.
    float density = body.offset.w > 0.0 ? 1.0 / (body.offset.w * whole.form.x) : cards[whole.surface.w].elastic.x;
    Weighed w = weighed(f, density, unit);
    bodies[slot] = stateOf(w, body, whole, breaking[object].center.xyz);
    setInertia(slot, w, shapes[parent]);
    setBreakable(slot, f, w, parent, unit);
    setBirth(slot, f, object, unit);
    atomicAdd(steps[STEPS_FRAGMENTS], 1u);
}
