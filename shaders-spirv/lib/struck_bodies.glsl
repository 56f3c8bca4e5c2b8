// Blows in a substep: bodies that strike others.
//
// Contacts that take turns once do not part bodies that are struck in several contacts at once, such as a compound that flies into a
// wall, or a stack that falls as one. Nor do they stop a heavy body that falls on a light one: the light one takes as much as it weighs
// in each sweep. So more sweeps follow, until little is left to be done.
//
// After a few sweeps impulses change by almost the same in each. So every third sweep makes its change once more, as many times as
// takes the most energy from the bodies (an exact line search), and not so often that a point would have to pull: a change that is cut
// off there may add energy.
//
// Wants lib/solve_contact.glsl and lib/pace.glsl, sync(), `turns_left` and the buffer `heights`, whose words are free in a substep.
shared uint hit, struck, heaviest; // hit: as haste() gives it, of the fastest contact; heaviest: kg, as bits
shared uint least_times;           // how often the last change may be made before a point pulls, as bits
shared uint most_done[4];          // SWEEP_*: the greatest of a contact, as bits
shared int sums_done[2];           // SWEEP_GAIN, SWEEP_LOSS, in shares of those
const uint kMostSweeps = 30u, kSweepsOfHeaps = 15u, kSweepsToSettle = 8u;
const float kEnough = 1e-5;      // of the greatest impulse
const float kMostRepeated = 1e4; // times

// Heaps do with less, and so do bodies of like masses in the soft solver: there sweeps follow only where a body is struck in two
// contacts. A contact alone waits for no other.
shared uint is_uneven; // whether a body of the island touches one that is much lighter
bool sweeps_on;

bool needsSweeps(uint lane, uvec2 range) {
    if (lane == 0u) is_uneven = push_.heaps_too;
    barrier();
    for (uint c = range.x + lane; c < range.y; c += LANES)
        if (solver_contacts[c].pace.w != 0u) is_uneven = 1u;
    barrier();
    return is_uneven != 0u && !rubs_in_push && range.y - range.x > 1u;
}

bool was_hit; // whether anything came in fast when the last sweep of a kind began

vec4 impulsesOf(uint c, uint points) {
    vec4 impulses = vec4(0.0);
    [[unroll]] for (uint k = 0u; k < MANIFOLD_POINTS; k++) impulses[k] = k < points ? solver_contacts[c].points[k].pulse.x : 0.0;
    return impulses;
}

float greatestOf(vec4 v) { return max(max(v.x, v.y), max(v.z, v.w)); }

// How much speed of separation each point lacks. Negative: it comes in too fast.
vec4 speedsLacking(uint c, uint points) {
    vec3 normal = solver_contacts[c].normal.xyz;
    Touching t = touchingOf(c, solver_contacts[c].ids, normal);
    vec4 spring = springOf(c), lacks = vec4(0.0);
    [[unroll]] for (uint k = 0u; k < MANIFOLD_POINTS; k++) {
        SolverPoint p = solver_contacts[c].points[k];
        vec3 demand = demandOf(separationOf(p, t, normal), p.pulse, spring);
        float gives = demand.z / demand.y * inverseOf(massAt(p, normal, t)) * max(p.pulse.x - solver_contacts[c].loads[k], 0.0);
        lacks[k] = k < points ? speedAt(p, normal, t) + demand.x + gives : 0.0;
    }
    return lacks;
}

bool comesInStill(uint c, uint points) {
    vec4 lacks = speedsLacking(c, points);
    bool comes = false;
    [[unroll]] for (uint k = 0u; k < MANIFOLD_POINTS; k++) {
        SolverPoint p = solver_contacts[c].points[k];
        comes = comes || (k < points && lacks[k] < -MEETING_SHARE * blowSpeed(p.arm_a.xyz, p.arm_b.xyz));
    }
    return comes;
}

// `stamp`: of this sweep.
void noteStrike(uint body, uint other, bool is_uneven_, bool is_blow, uint stamp) {
    float inverse = solver_bodies[body].velocity.w;
    if (inverse == 0.0) return;
    float others = solver_bodies[other].velocity.w;
    if (sweeps_on && others > 0.0 && is_uneven_ && inverse > others) struck = 1u;
    if (is_blow && atomicExchange(heights[body], stamp) == stamp) struck = 1u;
}

void noteStrikes(uint c, uint stamp) {
    uvec4 ids = solver_contacts[c].ids;
    float fastest = haste(c, ids.z);
    if (fastest < POINT_MET || greatestOf(impulsesOf(c, ids.z)) == 0.0) return;
    noteStrike(ids.x, ids.y, solver_contacts[c].pace.w != 0u, fastest >= POINT_HIT, stamp);
    noteStrike(ids.y, ids.x, solver_contacts[c].pace.w != 0u, fastest >= POINT_HIT, stamp);
}

bool anyStruck(uint lane, uvec2 range, bool wanted, uint stamp) {
    uint end = wanted ? range.y : range.x;
    for (uint c = range.x + lane; c < end; c += LANES) {
        float fastest = haste(c, solver_contacts[c].ids.z);
        if (fastest >= POINT_MET) atomicMax(hit, uint(fastest));
    }
    barrier();
    was_hit = float(hit) >= POINT_MET;
    end = float(hit) >= (sweeps_on ? POINT_MET : POINT_HIT) ? end : range.x;
    for (uint c = range.x + lane; c < end; c += LANES) noteStrikes(c, stamp);
    end = sweeps_on ? end : range.x; // a loop that turns zero times costs nothing where an `if` would
    for (uint c = range.x + lane; c < end; c += LANES)
        if (comesInStill(c, solver_contacts[c].ids.z)) struck = 1u;
    barrier();
    bool found = wanted && struck != 0u;
    barrier();
    return found;
}

// The number of sweeps of this kind that follow at the most.
uint moreSweeps(bool is_struck, bool settles, uint turns) {
    uint wanted = is_struck ? (sweeps_on ? kMostSweeps : kSweepsOfHeaps) : settles ? kSweepsToSettle : 0u;
    uint more = min(wanted, turns_left / turns);
    turns_left -= more * turns;
    return more;
}

void watch(uint lane, uvec2 range) {
    if (lane == 0u) {
        least_times = floatBitsToUint(kMostRepeated);
        for (uint k = 0u; k < 4u; k++) most_done[k] = 0u;
        sums_done[0] = sums_done[1] = 0;
    }
    for (uint c = range.x + lane; c < range.y; c += LANES) {
        uint points = solver_contacts[c].ids.z;
        solver_contacts[c].before = impulsesOf(c, points);
        solver_contacts[c].lacks = speedsLacking(c, points);
    }
}

float timesTo(vec4 now, vec4 change) {
    float least = kMostRepeated;
    for (uint k = 0u; k < MANIFOLD_POINTS; k++) least = change[k] < 0.0 ? min(least, now[k] / -change[k]) : least;
    return least;
}

void measureSweep(uint c) {
    uint points = solver_contacts[c].ids.z;
    vec4 now = impulsesOf(c, points), change = now - solver_contacts[c].before, lacks = speedsLacking(c, points);
    vec4 done = vec4(-dot(change, lacks), dot(change, lacks - solver_contacts[c].lacks), greatestOf(abs(change)), greatestOf(now));
    for (uint k = 0u; k < 4u; k++) atomicMax(most_done[k], floatBitsToUint(abs(done[k])));
    atomicMin(least_times, floatBitsToUint(timesTo(now, change)));
    solver_contacts[c].lacks = done;
}

// A power of two that scales values of at most this size to whole numbers up to 2^20: a sum of 1024 fits into 32 bits. 0 if all are tiny.
float perUnit(uint most) {
    uint exponent = most >> 23;
    return exponent > 20u && exponent < 255u ? uintBitsToFloat((273u - exponent) << 23) : 0.0;
}

// SWEEP_* of the last sweep, for all contacts together. Their order in a color is chance, so whole numbers are added.
vec4 doneBy(uint lane, uvec2 range) {
    for (uint c = range.x + lane; c < range.y; c += LANES) measureSweep(c);
    barrier();
    vec2 units = vec2(perUnit(most_done[SWEEP_GAIN]), perUnit(most_done[SWEEP_LOSS]));
    for (uint c = range.x + lane; c < range.y; c += LANES) {
        ivec2 share = ivec2(round(units * solver_contacts[c].lacks.xy));
        atomicAdd(sums_done[0], share.x);
        atomicAdd(sums_done[1], share.y);
    }
    sync();
    vec2 sums = vec2(sums_done[0], sums_done[1]) * vec2(inverseOf(units.x), inverseOf(units.y));
    return vec4(sums, uintBitsToFloat(most_done[SWEEP_CHANGE]), uintBitsToFloat(most_done[SWEEP_PRESSED]));
}

// Changes the impulses of a contact by `times` their change in the last sweep.
void repeatChange(uint c, float times) {
    uvec4 ids = solver_contacts[c].ids;
    vec3 normal = solver_contacts[c].normal.xyz;
    Touching t = touchingOf(c, ids, normal);
    vec4 before = solver_contacts[c].before;
    [[unroll]] for (uint k = 0u; k < MANIFOLD_POINTS; k++) {
        if (k >= ids.z) continue;
        SolverPoint p = solver_contacts[c].points[k];
        float total = max(p.pulse.x + times * (p.pulse.x - before[k]), 0.0);
        pushApart(t, p.arm_a.xyz, p.arm_b.xyz, (total - p.pulse.x) * normal);
        solver_contacts[c].points[k].pulse.x = total;
    }
    keepMotion(ids.x, t.a);
    keepMotion(ids.y, t.b);
}

void repeatChanges(uint lane, uvec2 range, float times) {
    uint at = times > 0.0 ? range.x : range.y;
    for (uint color = 0u; color < kMostContacts && at < range.y; color++) {
        uint end = color_ends[at];
        for (uint c = at + lane; c < end; c += LANES) repeatChange(c, times);
        sync();
        at = end;
    }
}

// Returns whether little is left to be done. If not, and if `repeats`, makes the change of the last sweep more often.
bool isDone(uint lane, uvec2 range, bool repeats) {
    vec4 done = doneBy(lane, range);
    float times = done[SWEEP_LOSS] > 0.0 ? clamp(done[SWEEP_GAIN] / done[SWEEP_LOSS], 0.0, uintBitsToFloat(least_times)) : 0.0;
    bool is_enough = max(times, 1.0) * done[SWEEP_CHANGE] <= kEnough * done[SWEEP_PRESSED];
    sync();
    repeatChanges(lane, range, repeats && !is_enough ? times : 0.0);
    return is_enough;
}

// Where bodies were struck, all contacts around took a part of the blow, and not only those that were hit. Applied again in the next
// substep, it would throw a light body out from under a heavy one. So a contact keeps what it had before, or what the heaviest body
// weighs in a substep: that may be a load that is there to stay.
void forgetBlow(uint c) {
    uint points = solver_contacts[c].ids.z;
    float now = dot(impulsesOf(c, points), vec4(1.0)), weight = gravity.w * length(gravity.xyz) * uintBitsToFloat(heaviest);
    float kept = max(dot(solver_contacts[c].first, vec4(1.0)), weight), share = now > kept ? kept / now : 1.0;
    for (uint k = 0u; k < MANIFOLD_POINTS && k < points; k++) solver_contacts[c].points[k].pulse.x *= share;
    if (kFriction != 0u) solver_contacts[c].rub.xyz *= share;
}

void weigh(uint body) {
    float inverse = solver_bodies[body].velocity.w;
    if (inverse > 0.0) atomicMax(heaviest, floatBitsToUint(1.0 / inverse));
}

void weighBodies(uint lane, uvec2 range) {
    if (lane == 0u) heaviest = 0u;
    barrier();
    for (uint c = range.x + lane; c < range.y; c += LANES) {
        weigh(solver_contacts[c].ids.x);
        weigh(solver_contacts[c].ids.y);
    }
    barrier();
}
