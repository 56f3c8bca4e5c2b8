// What is remembered of a contact becomes what is solved: separations as they are now, effective masses, the speed of approach
// that restitution goes by.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "lib/kernel.glsl"
#include "lib/component.glsl"
#include "lib/solver_body.glsl"
#include "lib/effect.glsl"
#include "shared/body.h"

FLAT_KERNEL;
FRICTION_EFFECT;
READS(0, uint, counts);
READS(1, uint, contact_pairs);
READS(2, uint, contact_slots);
READS(3, ContactMemory, memory);
READS(4, BodyState, bodies);
READS(5, SolverBody, solver_bodies);
WRITES(6, SolverContact, solver_contacts);
layout(push_constant) uniform Push { PreparePush push_; };
#include "lib/meeting.glsl"
#include "lib/symmetric_inverse.glsl"

float inverseOf(float x) { return x > 0.0 ? 1.0 / x : 0.0; }

// Impulses of the last step were for substeps of another length.
float scaleOf(uint pair) { return memory[pair].pace.x != 0u ? float(memory[pair].pace.x) / float(push_.substeps) : 1.0; }

SolverPoint pointOf(uint pair, uint k, Pair p, vec3 normal) {
    vec3 arm_a = memory[pair].arm_a[k].xyz + p.slid_a, arm_b = memory[pair].arm_b[k].xyz + p.slid_b;
    float separation = separationNow(pair, k, p, normal);
    float yield_ = yieldAlong(p.a, arm_a, normal, normal) + yieldAlong(p.b, arm_b, normal, normal);
    float speed = speedOfMeeting(dot(normal, velocityAt(p.b, arm_b) - velocityAt(p.a, arm_a)), separation, p, normal, push_.gravity);
    return SolverPoint(vec4(arm_a, separation), vec4(arm_b, inverseOf(yield_)), vec4(scaleOf(pair) * memory[pair].anchor_a[k].w, 0.0, speed, 0.0));
}

// Of friction at the center: the inverse of the two by two matrix of yields.
vec3 rubMass(Pair p, vec3 arm_a, vec3 arm_b, vec3 u, vec3 v) {
    float uu = yieldAlong(p.a, arm_a, u, u) + yieldAlong(p.b, arm_b, u, u);
    float uv = yieldAlong(p.a, arm_a, u, v) + yieldAlong(p.b, arm_b, u, v);
    float vv = yieldAlong(p.a, arm_a, v, v) + yieldAlong(p.b, arm_b, v, v);
    float determinant = uu * vv - uv * uv;
    return determinant > 0.0 ? vec3(vv, -uv, uu) / determinant : vec3(0.0);
}

// How much speed an impulse at each point gives at each other one, inverted. Four corners of a plate share three ways to move, so
// the matrix A of that has no inverse: A / (A A + d d) is one for speeds that the points can have, and has nothing to say about
// others, such as the noise of opposite corners against the other two (Tikhonov 1963). Impulses are as even as they can be.
const float kDoubt = 0.02; // d, of the mean diagonal

mat4 pressMass(uint pair, uint points, Pair p, vec3 normal) {
    mat4 yields = mat4(1.0);
    float trace = 0.0;
    for (uint i = 0u; i < points; i++) {
        vec3 twist_a = spinBy(p.a, cross(memory[pair].arm_a[i].xyz + p.slid_a, normal));
        vec3 twist_b = spinBy(p.b, cross(memory[pair].arm_b[i].xyz + p.slid_b, normal));
        vec4 column = vec4(0.0);
        for (uint j = 0u; j < points; j++) {
            float yield_ = p.a.inverse_mass + p.b.inverse_mass + dot(cross(memory[pair].arm_a[j].xyz + p.slid_a, normal), twist_a) +
                           dot(cross(memory[pair].arm_b[j].xyz + p.slid_b, normal), twist_b);
            column = withComponent(column, j, yield_);
            trace += j == i ? yield_ : 0.0;
        }
        for (uint k = 0u; k < MANIFOLD_POINTS; k++) yields[k] = k == i ? column : yields[k];
    }
    if (trace == 0.0) return mat4(0.0);
    yields *= float(points) / trace;
    for (uint i = 0u; i < MANIFOLD_POINTS; i++)
        for (uint j = 0u; j < MANIFOLD_POINTS; j++) yields[i][j] = i < points && j < points ? yields[i][j] : 0.0;
    return float(points) / trace * (yields * symmetricInverse(yields * yields + mat4(kDoubt * kDoubt)));
}

// Gravity says how fast overlap may be pushed out. Under little or none a share of the shorter arm in a step counts, which scales
// with the bodies.
float mostPush(Pair p, vec3 arm_a, vec3 arm_b) {
    float a = p.a.inverse_mass > 0.0 ? length(arm_a) : 3e38, b = p.b.inverse_mass > 0.0 ? length(arm_b) : 3e38;
    return max(push_.most_push, push_.push_share * min(a, b) / (float(push_.substeps) * push_.gravity.w));
}

void main() {
    uint at = flatIndex();
    if (at >= counts[COUNT_CONTACTS]) return;
    uint pair = contact_pairs[at], c = contact_slots[at];
    uvec4 ids = memory[pair].ids;
    vec4 normal = memory[pair].normal, tangent = memory[pair].tangent;
    Pair p = pairNow(pair, ids);
    vec3 center_a = vec3(0.0), center_b = vec3(0.0);
    uint points = min(ids.z, MANIFOLD_POINTS);
    for (uint k = 0u; k < points; k++) {
        center_a += memory[pair].arm_a[k].xyz / float(points);
        center_b += memory[pair].arm_b[k].xyz / float(points);
    }
    bool fixed_ = p.a.inverse_mass == 0.0 || p.b.inverse_mass == 0.0;
    float arms = fixed_ ? float(ARMS_STAY) : memory[pair].rub.w;
    // B's center from A's, where both were one when the points were found (lib/solve_contact.glsl).
    vec3 slid = p.way + center_b - center_a;
    if (arms == float(ARMS_OF_A_FOLLOW)) p.slid_a = slid;
    if (arms == float(ARMS_OF_B_FOLLOW)) p.slid_b = -slid;
    float reach = 0.0;
    for (uint k = 0u; k < points; k++) {
        reach += length(memory[pair].arm_a[k].xyz - center_a) / float(points);
        solver_contacts[c].points[k] = pointOf(pair, k, p, normal.xyz);
    }
    float twist = dot(normal.xyz, spinBy(p.a, normal.xyz) + spinBy(p.b, normal.xyz));
    solver_contacts[c].ids = uvec4(ids.xy, points, pair);
    solver_contacts[c].normal = normal;
    solver_contacts[c].tangent = tangent;
    solver_contacts[c].center_a = vec4(center_a + p.slid_a, inverseOf(twist));
    solver_contacts[c].center_b = vec4(center_b + p.slid_b, reach);
    mat4 press = pressMass(pair, points, p, normal.xyz);
    for (uint k = 0u; k < MANIFOLD_POINTS; k++) solver_contacts[c].press[k] = press[k];
    if (kFriction != 0u) solver_contacts[c].rub.xyz = scaleOf(pair) * memory[pair].rub.xyz;
    solver_contacts[c].rub.w = mostPush(p, center_a + p.slid_a, center_b + p.slid_b);
    vec4 loads = vec4(0.0);
    for (uint k = 0u; k < points; k++) loads = withComponent(loads, k, LOAD_CARRIED * scaleOf(pair) * max(memory[pair].arm_b[k].w, 0.0));
    solver_contacts[c].loads = loads;
    solver_contacts[c].pace = uvec4(memory[pair].pace.x, push_.substeps, 0u, 0u);
    vec3 rub_mass = vec3(0.0);
    if (kFriction != 0u) rub_mass = rubMass(p, center_a + p.slid_a, center_b + p.slid_b, tangent.xyz, cross(normal.xyz, tangent.xyz));
    solver_contacts[c].rub_mass = vec4(rub_mass, arms);
}
