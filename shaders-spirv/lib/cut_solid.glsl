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
// Wants LANES and lib/exact_store.glsl.
#define PLANE_MASKS (PLANES / 32)
#define CORNER_MASKS ((CORNERS + 31) / 32)
#define RIM_TURNS (PLANES / LANES)

shared uint corner_mask[CORNER_MASKS];
shared uint plane_mask[PLANE_MASKS]; // that bound the solid
shared uint rim_mask[PLANE_MASKS];
shared uint corner_top, gone_count, deep_count;

bool liveCorner(uint t) { return t < CORNERS && (corner_mask[min(t, CORNERS - 1u) >> 5] >> (t & 31u) & 1u) != 0u; }
bool livePlane(uint p) { return (plane_mask[p >> 5] >> (p & 31u) & 1u) != 0u; }

uint bitAt(uint word, uint rank) {
    for (uint k = 0u; k < min(rank, 32u); k++) word &= word - 1u;
    return uint(findLSB(word));
}

// The place of the set bit before which there are `rank` others.
uint rimPlane(uint rank) {
    uint first = uint(bitCount(rim_mask[0]));
    return rank < first ? bitAt(rim_mask[0], rank) : 32u + bitAt(rim_mask[1], rank - first);
}

uint freeCorner(uint rank) {
    uint found = CORNERS - 1u;
    bool open = true;
    for (uint m = 0u; m < ROLLED(CORNER_MASKS); m++) {
        uint spare = ~corner_mask[m], count = uint(bitCount(spare));
        if (open && rank < count) {
            found = 32u * m + bitAt(spare, rank);
            open = false;
        }
        rank -= min(rank, count);
    }
    return min(found, CORNERS - 1u);
}

uint freePlane() {
    uint first = uint(findLSB(~plane_mask[0])), second = 32u + uint(findLSB(~plane_mask[1]));
    return plane_mask[0] != 0xffffffffu ? first : (plane_mask[1] != 0xffffffffu ? second : uint(PLANES));
}

// No plane yet, and room for so many corners.
void clearSolid(uint lane, uint corners_) {
    for (uint p = lane; p < PLANES; p += LANES) {
        rim_sum[p] = 0;
        rim_squares[p] = 0;
    }
    if (lane < CORNER_MASKS) {
        uint until = corners_ - min(corners_, 32u * lane);
        corner_mask[lane] = until >= 32u ? 0xffffffffu : (1u << until) - 1u;
    }
    if (lane == 0u) corner_top = corners_;
}

// From a box: planes 0 to 5, a side a lane.
void startFromSides(uint lane, Plane side) {
    clearSolid(lane, 8u);
    if (lane < 6u) setPlane(lane, side.d, side.id, side.r);
    barrier();
    if (lane < 8u) {
        uint x = lane & 1u, y = 2u + ((lane >> 1) & 1u), z = 4u + (lane >> 2);
        bool odd = ((lane ^ (lane >> 1) ^ (lane >> 2)) & 1u) != 0u;
        makeCorner(lane, x, odd ? y : z, odd ? z : y);
    }
    barrier();
}

// Which planes still bound the solid.
void countPlanes(uint lane) {
    if (lane < PLANE_MASKS) {
        plane_mask[lane] = 0u;
        rim_mask[lane] = 0u;
    }
    if (lane == 0u) {
        gone_count = 0u;
        deep_count = 0u;
    }
    barrier();
    for (uint t = lane; t < corner_top; t += LANES) {
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

// The lane's corners outside of e, a bit a turn; counts them, and those outside by more than `deep`.
uint cornersBeyond(uint lane, Plane e, int64_t deep) {
    uint mine = 0u, turn = 0u;
    for (uint t = lane; t < corner_top; t += LANES) {
        Corner c = loadCorner(t);
        Wide128 s = wideAdd(wideScale(c.moment[0], int64_t(e.d.x)), wideScale(c.moment[1], int64_t(e.d.y)));
        s = wideAdd(s, wideScale(c.moment[2], int64_t(e.d.z)));
        s = wideSub(s, wideScale(c.volume, e.r));
        bool outside = liveCorner(t) && wideSign(s) > 0;
        if (outside) atomicAdd(gone_count, 1u);
        if (outside && wideSign(wideSub(s, wideScale(c.volume, deep))) > 0) atomicAdd(deep_count, 1u);
        mine |= outside ? 1u << turn : 0u;
        turn++;
    }
    barrier();
    return mine;
}

// Every plane on the rim makes its new corner with the next one and e.
void closeRim(uint lane, uint e) {
    for (uint p = lane; p < PLANES; p += LANES) {
        if (rim_sum[p] != 0) atomicOr(rim_mask[p >> 5], 1u << (p & 31u));
    }
    barrier();
    uint total = uint(bitCount(rim_mask[0]) + bitCount(rim_mask[1])), added[RIM_TURNS];
    for (uint turn = 0u; turn < RIM_TURNS; turn++) added[turn] = CORNERS;
    for (uint turn = 0u; turn < (total + LANES - 1u) / LANES; turn++) {
        uint k = turn * LANES + lane;
        if (k < total) {
            uint p = rimPlane(k), t = freeCorner(k);
            int sum = rim_sum[p], next = (rim_squares[p] / sum + sum) / 2;
            makeCorner(t, p, uint(next), e);
            added[turn % RIM_TURNS] = t;
        }
    }
    barrier();
    for (uint turn = 0u; turn < RIM_TURNS; turn++) {
        uint t = added[turn];
        if (t < CORNERS) {
            atomicOr(corner_mask[t >> 5], 1u << (t & 31u));
            atomicMax(corner_top, t + 1u);
        }
    }
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
    countPlanes(lane);
    uint mine = cornersBeyond(lane, e, deep), slot = freePlane(), live = 0u, turn = 0u;
    for (uint m = 0u; m < ROLLED(CORNER_MASKS); m++) live += uint(bitCount(corner_mask[m]));
    bool cuts = deep_count != 0u, fits = slot < PLANES && gone_count < live;
    barrier();
    if (!cuts || !fits) return cuts ? CUT_REFUSED : CUT_NOTHING;
    for (uint t = lane; t < corner_top; t += LANES) {
        if ((mine >> turn & 1u) != 0u) removeCorner(t);
        turn++;
    }
    if (lane == 0u) setPlane(slot, e.d, e.id, e.r);
    barrier();
    closeRim(lane, slot);
    return CUT_DONE;
}
