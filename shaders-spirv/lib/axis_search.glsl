// The separating axis theorem as a search for the best of many axes, shared by the lanes of a workgroup.
//
// The normals that matter, those of the faces of B - A, are A's faces, B's faces turned around, and cross products of two edges
// whose Gauss images cross. Along each, B is separate from A by some height, negative where they overlap, and moves by some speed.
// The largest separation tells how far apart the hulls are, or how shallow they overlap. With speeds, the same normals clip the
// way of B as a ray is clipped by a convex polytope (the paper, section 6, takes intervals): it touches A at the latest time at
// which it passes a plane inward, if that is before the first at which it is out of another. Which axis wins depends on values
// and ids alone, not on the lane that saw it.
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

// `doubt`: what the separation may be off by. What is in doubt hinders no impact.
void see(inout Seen seen, float separation, float speed, float doubt, uint feature) {
    if (isBetter(separation, feature, seen.separation, seen.feature)) {
        seen.separation = separation;
        seen.feature = feature;
    }
    bool outside = separation > doubt, inside = separation < -doubt || doubt == 0.0;
    float time = speed == 0.0 ? kFar : -separation / speed;
    if (outside && speed < 0.0 && isBetter(time, feature, seen.enter, seen.enter_feature)) {
        seen.enter = time;
        seen.enter_feature = feature;
    }
    if (outside && speed >= 0.0) seen.leave = -1.0;
    if (!outside && inside && speed > 0.0) seen.leave = min(seen.leave, time);
}

shared vec4 seen_values[LANES]; // separation, enter, leave, reach
shared uvec2 seen_features[LANES];

// What all lanes have seen together.
Seen seenByAll(Seen mine) {
    barrier();
    seen_values[lane] = vec4(mine.separation, mine.enter, mine.leave, mine.reach);
    seen_features[lane] = uvec2(mine.feature, mine.enter_feature);
    barrier();
    Seen all = seenNothing();
    for (uint k = 0u; k < ROLLED(LANES); k++) {
        vec4 values = seen_values[k];
        uvec2 features = seen_features[k];
        if (isBetter(values.x, features.x, all.separation, all.feature)) {
            all.separation = values.x;
            all.feature = features.x;
        }
        if (isBetter(values.y, features.y, all.enter, all.enter_feature)) {
            all.enter = values.y;
            all.enter_feature = features.y;
        }
        all.leave = min(all.leave, values.z);
        all.reach = min(all.reach, values.w);
    }
    return all;
}

shared vec4 seen_heights[LANES];

// Heights of all corners along n, kept with the corners: lowest and highest of A, then of B.
vec4 measureAlong(vec3 n) {
    vec4 mine = vec4(kFar, -kFar, kFar, -kFar);
    for (uint side = 0u; side < 2u; side++) {
        for (uint v = lane; v < corner_count[side]; v += LANES) {
            float height = dot(n, corners[side * HULL_VERTICES + v].xyz);
            corners[side * HULL_VERTICES + v].w = height;
            if (side == 0u)
                mine.xy = vec2(min(mine.x, height), max(mine.y, height));
            else
                mine.zw = vec2(min(mine.z, height), max(mine.w, height));
        }
    }
    barrier();
    seen_heights[lane] = mine;
    barrier();
    vec4 all = mine;
    for (uint k = 0u; k < ROLLED(LANES); k++) {
        vec4 other = seen_heights[k];
        all = vec4(min(all.x, other.x), max(all.y, other.y), min(all.z, other.z), max(all.w, other.w));
    }
    return all;
}

#endif
