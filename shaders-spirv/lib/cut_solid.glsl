// A convex solid of at most COLLIDER_PLANES planes, cut by one plane after the other in integers: one workgroup, everything in
// shared memory (lib/exact_store.glsl). Corners are triples of planes; which of them a plane cuts off is the sign of a whole
// number, so no rounding ever puts the solid's faces together wrongly.
//
// Here it need not be settled on which side a corner lies that is exactly in the plane: it stays. That is as good as pushing
// every plane outward by less than any number, each by far more than all those before it, so the solid is always one with
// three planes at every corner, and what is cut off is always one piece whose rim visits every plane at most once. Each corner
// that goes adds differences of its planes' places to their sums; inner edges cancel, and a plane on the rim is left with
// next - prev and next^2 - prev^2, from which its new corner follows.
//
// Rounded places decide where they leave no doubt; only corners in question are asked in integers, all of them at once.
//
// Wants LANES and lib/exact_store.glsl.
#define PLANE_MASKS (PLANES / 32)
#define CORNER_MASKS ((CORNERS + 31) / 32)

shared uint corner_mask[CORNER_MASKS];
shared uint plane_mask[PLANE_MASKS]; // that may bound the solid: all that do, until they are counted some that do not
shared uint beyond_mask[CORNER_MASKS];
shared uint rim_mask[PLANE_MASKS];
shared uint rim_planes[PLANES];  // along the new face, in the order of their numbers
shared uint free_corners[PLANES];
shared uint corner_top, gone_count, deep_count, open_count;

// Of the 65,535 loop turns that Mesa's software device allows; the same for all lanes.
uint budget = 50000u;
void spend(uint turns) { budget -= min(budget, turns); }

bool liveCorner(uint t) { return t < CORNERS && (corner_mask[min(t, CORNERS - 1u) >> 5] >> (t & 31u) & 1u) != 0u; }
bool livePlane(uint p) { return (plane_mask[p >> 5] >> (p & 31u) & 1u) != 0u; }

// How many corners, or planes, of a mask come before one.
uint cornersBefore(uint t, uint masks[CORNER_MASKS]) {
    uint rank = 0u;
    [[unroll]] for (uint m = 0u; m < CORNER_MASKS; m++) {
        uint below = t >= 32u * m + 32u ? 0xffffffffu : (t > 32u * m ? (1u << (t - 32u * m)) - 1u : 0u);
        rank += uint(bitCount(masks[m] & below));
    }
    return rank;
}

uint planesBefore(uint p, uint masks[PLANE_MASKS]) {
    uint before = (1u << (p & 31u)) - 1u;
    return p < 32u ? uint(bitCount(masks[0] & before)) : uint(bitCount(masks[0]) + bitCount(masks[1] & before));
}

uint freePlane() {
    uint first = uint(findLSB(~plane_mask[0])), second = 32u + uint(findLSB(~plane_mask[1]));
    return plane_mask[0] != 0xffffffffu ? first : (plane_mask[1] != 0xffffffffu ? second : uint(PLANES));
}

// Room for so many planes and corners, which are then set.
void clearSolid(uint lane, uint planes, uint corners_) {
    for (uint p = lane; p < PLANES; p += LANES) {
        rim_sum[p] = 0;
        rim_squares[p] = 0;
    }
    if (lane < CORNER_MASKS) {
        uint until = corners_ - min(corners_, 32u * lane);
        corner_mask[lane] = until >= 32u ? 0xffffffffu : (1u << until) - 1u;
    }
    if (lane < PLANE_MASKS) {
        uint until = planes - min(planes, 32u * lane);
        plane_mask[lane] = until >= 32u ? 0xffffffffu : (1u << until) - 1u;
    }
    if (lane == 0u) corner_top = corners_;
}

// From a box: planes 0 to 5, a side a lane.
void startFromSides(uint lane, Plane side) {
    clearSolid(lane, 6u, 8u);
    if (lane < 6u) setPlane(lane, side);
    barrier();
    if (lane < 8u) {
        uint x = lane & 1u, y = 2u + ((lane >> 1) & 1u), z = 4u + (lane >> 2);
        bool odd = ((lane ^ (lane >> 1) ^ (lane >> 2)) & 1u) != 0u;
        makeCorner(lane, x, odd ? y : z, odd ? z : y);
    }
    barrier();
}

// Which planes still bound the solid; where that is not needed, nothing is done.
void countPlanes(uint lane, bool needed) {
    barrier(); // all have asked whether it is needed
    if (needed && lane < PLANE_MASKS) plane_mask[lane] = 0u;
    barrier();
    uint last = needed ? corner_top : 0u;
    for (uint t = lane; t < last; t += LANES) {
        uvec2 planes = corner_planes[t];
        uvec3 p = uvec3(planes.x & 0xffffu, planes.x >> 16, planes.y);
        bool live = liveCorner(t);
        for (uint k = 0u; k < ROLLED(3); k++) {
            if (live) atomicOr(plane_mask[p[k] >> 5], 1u << (p[k] & 31u));
        }
    }
    barrier();
}

void removeCorner(uint t) {
    uvec2 planes = corner_planes[t];
    int a = int(planes.x & 0xffffu), b = int(planes.x >> 16), c = int(planes.y);
    atomicAnd(corner_mask[t >> 5], ~(1u << (t & 31u)));
    atomicAdd(rim_sum[a], b - c);
    atomicAdd(rim_sum[b], c - a);
    atomicAdd(rim_sum[c], a - b);
    atomicAdd(rim_squares[a], b * b - c * c);
    atomicAdd(rim_squares[b], c * c - a * a);
    atomicAdd(rim_squares[c], a * a - b * b);
}

// By magnitude, as wideToFloat.
float longToFloat(int64_t a) {
    bool negative = isNegative(a);
    uint64_t m = uint64_t(negative ? -a : a);
    float f = float(uint(m >> 32)) * 4294967296.0 + float(uint(m));
    return negative ? -f : f;
}

void sortOut(uint t, bool outside, bool deep) {
    if (outside) {
        atomicOr(beyond_mask[t >> 5], 1u << (t & 31u));
        atomicAdd(gone_count, 1u);
    }
    if (outside && deep) atomicAdd(deep_count, 1u);
}

// Corners that are for certain outside of e, and whether by more than `deep`; those in question are listed in `slots`.
void askPlaces(uint lane, Plane e, int64_t deep) {
    vec3 d = vec3(e.d);
    float size = length(d), bound = longToFloat(e.r), deeper = longToFloat(e.r + deep);
    float slack_of_bounds = kPlaceError * max(abs(bound), abs(deeper));
    for (uint t = lane; t < corner_top; t += LANES) {
        vec4 place = corner_place[t];
        float q = dot(d, place.xyz), slack = size * place.w + slack_of_bounds;
        bool live = liveCorner(t), in_doubt = abs(q - bound) <= slack || abs(q - deeper) <= slack;
        if (live && in_doubt) slots[atomicAdd(open_count, 1u)] = t;
        sortOut(t, live && !in_doubt && q > bound, q > deeper);
    }
    barrier();
}

void askNumbers(uint lane, Plane e, int64_t deep) {
    for (uint k = lane; k < open_count; k += LANES) {
        uint t = slots[k];
        Corner c = loadCorner(t);
        Wide128 s = wideAdd(wideScale(c.moment[0], int64_t(e.d.x)), wideScale(c.moment[1], int64_t(e.d.y)));
        s = wideAdd(s, wideScale(c.moment[2], int64_t(e.d.z)));
        s = wideSub(s, wideScale(c.volume, e.r));
        sortOut(t, wideSign(s) > 0, wideSign(wideSub(s, wideScale(c.volume, deep))) > 0);
    }
    barrier();
}

void findBeyond(uint lane, Plane e, int64_t deep) {
    if (lane < CORNER_MASKS) beyond_mask[lane] = 0u;
    if (lane < PLANE_MASKS) rim_mask[lane] = 0u;
    if (lane == 0u) {
        gone_count = 0u;
        deep_count = 0u;
        open_count = 0u;
    }
    barrier();
    askPlaces(lane, e, deep);
    askNumbers(lane, e, deep);
}

void findRim(uint lane) {
    for (uint p = lane; p < PLANES; p += LANES) {
        if (rim_sum[p] != 0) atomicOr(rim_mask[p >> 5], 1u << (p & 31u));
    }
    barrier();
    for (uint p = lane; p < PLANES; p += LANES) {
        if (rim_sum[p] != 0) rim_planes[planesBefore(p, rim_mask)] = p;
    }
    for (uint t = lane; t < CORNERS; t += LANES) {
        uint rank = t - cornersBefore(t, corner_mask);
        if (!liveCorner(t) && rank < PLANES) free_corners[rank] = t;
    }
    barrier();
}

// Every plane on the rim makes its new corner with the next one and e.
void closeRim(uint lane, uint e) {
    findRim(lane);
    uint total = uint(bitCount(rim_mask[0]) + bitCount(rim_mask[1]));
    for (uint k = lane; k < total; k += LANES) {
        uint p = rim_planes[k], t = free_corners[k];
        int sum = rim_sum[p], next = (rim_squares[p] / sum + sum) / 2;
        makeCorner(t, p, uint(next), e);
        atomicOr(corner_mask[t >> 5], 1u << (t & 31u));
        atomicMax(corner_top, t + 1u);
    }
    barrier();
    for (uint p = lane; p < PLANES; p += LANES) {
        rim_sum[p] = 0;
        rim_squares[p] = 0;
    }
    barrier();
}

#define CUT_NOTHING 0u
#define CUT_DONE 1u
#define CUT_REFUSED 2u /* no room for one more plane, or nothing would be left */

// Cuts by e where it takes off more than `deep`, in units of its bound.
uint cutBy(uint lane, Plane e, int64_t deep) {
    spend(8u * (corner_top / LANES + 1u) + 4u * PLANES / LANES + CORNERS / LANES + 24u);
    findBeyond(lane, e, deep);
    countPlanes(lane, freePlane() == PLANES);
    uint slot = freePlane(), live = 0u;
    for (uint m = 0u; m < ROLLED(CORNER_MASKS); m++) live += uint(bitCount(corner_mask[m]));
    bool cuts = deep_count != 0u, fits = slot < PLANES && gone_count < live;
    barrier();
    if (!cuts || !fits) return cuts ? CUT_REFUSED : CUT_NOTHING;
    for (uint t = lane; t < corner_top; t += LANES) {
        if ((beyond_mask[t >> 5] >> (t & 31u) & 1u) != 0u) removeCorner(t);
    }
    if (lane == 0u) {
        setPlane(slot, e);
        plane_mask[slot >> 5] |= 1u << (slot & 31u);
    }
    barrier();
    closeRim(lane, slot);
    return CUT_DONE;
}
