// Four of many candidates that hold as well as all: the deepest, the one furthest from it, the one furthest from the line of the
// two, and the one furthest outside the triangle of the three. Equal ones by their place in the list. If the face that the body lies
// on is a triangle, its corners are the first three.
#ifndef CONTACT_REDUCTION_GLSL
#define CONTACT_REDUCTION_GLSL

float turnOf(vec2 a, vec2 b, vec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

uint deepestOf() {
    uint best = 0u;
    float least = candidate_at[0].z;
    for (uint k = 1u; k < candidate_count; k++) {
        float height = candidate_at[k].z;
        best = height < least ? k : best;
        least = height < least ? height : least;
    }
    return best;
}

uint furthestFrom(uint a) {
    uint best = a;
    float most = 0.0;
    vec2 from = candidate_at[a].xy;
    for (uint k = 0u; k < candidate_count; k++) {
        vec2 d = candidate_at[k].xy - from;
        if (dot(d, d) > most) {
            most = dot(d, d);
            best = k;
        }
    }
    return best;
}

uint furthestBeside(uint a, uint b) {
    uint best = a;
    float most = 0.0;
    vec2 from = candidate_at[a].xy, to = candidate_at[b].xy;
    for (uint k = 0u; k < candidate_count; k++) {
        float beside = abs(turnOf(from, to, candidate_at[k].xy));
        if (beside > most) {
            most = beside;
            best = k;
        }
    }
    return best;
}

uint furthestOutside(uint a, uint b, uint c) {
    vec2 p = candidate_at[a].xy, q = candidate_at[b].xy, r = candidate_at[c].xy;
    float side = turnOf(p, q, r) < 0.0 ? -1.0 : 1.0;
    uint best = a;
    float most = 0.0;
    for (uint k = 0u; k < candidate_count; k++) {
        vec2 at = candidate_at[k].xy;
        float outside = -min(side * turnOf(p, q, at), min(side * turnOf(q, r, at), side * turnOf(r, p, at)));
        if (outside > most) {
            most = outside;
            best = k;
        }
    }
    return best;
}

// The chosen ones in the order of the list, NO_INDEX behind them.
uvec4 chosen() {
    if (candidate_count <= 4u) {
        uvec4 all = uvec4(0u, 1u, 2u, 3u);
        return mix(all, uvec4(NO_INDEX), greaterThanEqual(all, uvec4(candidate_count)));
    }
    bool is_triangle = own_count == 3u;
    uint a = is_triangle ? 0u : deepestOf(), b = is_triangle ? 1u : furthestFrom(a);
    uint c = is_triangle ? 2u : furthestBeside(a, b), d = furthestOutside(a, b, c);
    uvec4 picked = uvec4(NO_INDEX);
    uint count = 0u;
    for (uint k = 0u; k < candidate_count; k++) {
        if (k != a && k != b && k != c && k != d) continue;
        picked[count] = k;
        count++;
    }
    return picked;
}

#endif
