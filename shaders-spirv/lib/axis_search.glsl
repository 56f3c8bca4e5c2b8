// The separating axis theorem as a search for the best of many axes, shared by the lanes of a workgroup.
//
// The normals that matter, those of the faces of B - A, are A's faces, B's faces turned around, and cross products of two edges
// whose Gauss images cross. Along each, B is separate from A by some height, negative where they overlap, and moves by some speed.
// The largest separation tells how far apart the hulls are, or how shallow they overlap. With speeds, the same normals clip the
// way of B as a ray is clipped by a convex polytope (the paper, section 6, takes intervals): it touches A at the latest time at
// which it passes a plane inward, if that is before the first at which it is out of another. Which axis wins depends on values
// and ids alone, not on the lane that saw it.
// Wants `corners`, `corner_counts` and `lane` declared.
#ifndef AXIS_SEARCH_GLSL
#define AXIS_SEARCH_GLSL

const float kFar = 3e38;

struct Seen {
    float separation; // the largest
    uint feature;
    float enter; // share of the step
    uint enter_feature;
    float leave;
    float reach; // of this hull from its center towards the other, as a share of the way between the centers
};

Seen seenNothing() { return Seen(-kFar, NO_INDEX, -kFar, NO_INDEX, kFar, kFar); }

bool isBetter(float value, uint feature, float than, uint than_feature) {
    return value > than || (value == than && feature < than_feature);
}

// `doubt`: what the separation may be off by, which hinders no impact. Whether this is the best so far, by separation
// and by time.
bvec2 see(inout Seen seen, float separation, float speed, float doubt, uint feature) {
    bool outside = separation > doubt;
    float time = speed == 0.0 ? kFar : -separation / speed;
    bool is_best = isBetter(separation, feature, seen.separation, seen.feature);
    bool is_last = outside && speed < 0.0 && isBetter(time, feature, seen.enter, seen.enter_feature);
    seen.separation = is_best ? separation : seen.separation;
    seen.feature = is_best ? feature : seen.feature;
    seen.enter = is_last ? time : seen.enter;
    seen.enter_feature = is_last ? feature : seen.enter_feature;
    float leave = speed > 0.0 ? (doubt - separation) / speed : kFar;
    seen.leave = min(seen.leave, outside && speed >= 0.0 ? -1.0 : leave);
    return bvec2(is_best, is_last);
}

// Halves take turns, so that one barrier does: whoever writes one again has passed the barrier behind which all read the other.
// Each barrier that is left out saves time, and what a software device takes to compile all that lives across it.
shared vec4 seen_values[2u * LANES]; // separation, enter, leave, reach
shared uvec2 seen_features[2u * LANES];
uint seen_from = 0u;

// What all lanes have seen together.
Seen seenByAll(Seen mine) {
    seen_from = LANES - seen_from;
    seen_values[seen_from + lane] = vec4(mine.separation, mine.enter, mine.leave, mine.reach);
    seen_features[seen_from + lane] = uvec2(mine.feature, mine.enter_feature);
    barrier();
    Seen all = seenNothing();
    for (uint k = 0u; k < ROLLED(LANES); k++) {
        vec4 values = seen_values[seen_from + k];
        uvec2 features = seen_features[seen_from + k];
        bool is_best = isBetter(values.x, features.x, all.separation, all.feature);
        bool is_last = isBetter(values.y, features.y, all.enter, all.enter_feature);
        all = Seen(is_best ? values.x : all.separation, is_best ? features.x : all.feature, is_last ? values.y : all.enter,
                   is_last ? features.y : all.enter_feature, min(all.leave, values.z), min(all.reach, values.w));
    }
    return all;
}

// Heights of all corners along n, kept with the corners: lowest and highest of A, then of B.
vec4 measureAlong(vec3 n) {
    vec4 most = vec4(-kFar); // with the lowest turned over, so that all are maxima
    for (uint v = lane; v < corner_counts.x + corner_counts.y; v += LANES) {
        float height = dot(n, corners[v].xyz);
        corners[v].w = height;
        vec2 both = vec2(-height, height);
        most = max(most, v < corner_counts.x ? vec4(both, vec2(-kFar)) : vec4(vec2(-kFar), both));
    }
    seen_from = LANES - seen_from;
    seen_values[seen_from + lane] = most;
    barrier();
    for (uint k = 0u; k < ROLLED(LANES); k++) most = max(most, seen_values[seen_from + k]);
    return most * vec4(-1, 1, -1, 1);
}

#endif
