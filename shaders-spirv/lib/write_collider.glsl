// A finished solid as vertices, planes and loops. Corners that come to lie on one place are one vertex; faces that this leaves
// without area go. Where rounding has put corners together that no edge of length 0 joins, so that the surface would touch
// itself, all corners stay what they are: the surface is always that of a ball, which V - E + F = 2 tells.
// Loops run counter-clockwise seen from outside: after corner (p, x, y) of plane p comes (p, y, z).
//
// Wants lib/cut_solid.glsl, fragment, cell, site, lacks, step_size, loose_colliders and collider_sizes.
shared uint vertex_mask[CORNER_MASKS];
shared uint face_mask[PLANE_MASKS];

vec3 placeInModel(uint t) { return (vec3(inTile(site) - ivec3(kGridMiddle)) + 0.5 * corner_place[t].xyz) * step_size; }

uint vertexRank(uint t) { return cornersBefore(t, vertex_mask); }

// Which corner follows p and then x around a corner: a byte an entry, in the memory of the corners' numbers, which nothing
// needs any more.
void setFollower(uint p, uint x, uint t) {
    uint at = p * PLANES + x;
    atomicOr(corner_store[at >> 2], t << (8u * (at & 3u)));
}

uint followerOf(uint p, uint x) {
    uint at = p * PLANES + x;
    return corner_store[at >> 2] >> (8u * (at & 3u)) & 0xffu;
}

// The plane before p around corner t.
uint planeBefore(uint t, uint p) {
    uvec2 planes = corner_planes[t];
    uint a = planes.x & 0xffffu, b = planes.x >> 16;
    return p == a ? planes.y : (p == b ? a : b);
}

void placeCorners(uint lane) {
    for (uint t = lane; t < corner_top; t += LANES) corner_place[t] = vec4(placeInModel(t), 0.0);
    barrier();
}

void forgetLinks(uint lane) {
    for (uint k = lane; k < PLANES * PLANES / 4; k += LANES) corner_store[k] = 0u;
    for (uint p = lane; p < PLANES; p += LANES) rim_sum[p] = CORNERS;
    if (lane < CORNER_MASKS) vertex_mask[lane] = 0u;
    if (lane < PLANE_MASKS) face_mask[lane] = 0u;
    barrier();
}

void linkCorners(uint lane, bool welds) {
    for (uint t = lane; t < corner_top; t += LANES) {
        if (liveCorner(t)) {
            uvec2 planes = corner_planes[t];
            uvec3 p = uvec3(planes.x & 0xffffu, planes.x >> 16, planes.y);
            setFollower(p.x, p.y, t);
            setFollower(p.y, p.z, t);
            setFollower(p.z, p.x, t);
            atomicMin(rim_sum[p.x], int(t));
            atomicMin(rim_sum[p.y], int(t));
            atomicMin(rim_sum[p.z], int(t));
        }
        uint same = t;
        vec3 place = corner_place[t].xyz;
        for (uint u = 0u; u < corner_top; u++) {
            if (welds && u < same && liveCorner(u) && corner_place[u].xyz == place) same = u;
        }
        slots[t] = same;
    }
    barrier();
}

// Walks the loop of plane p; writes its vertices from `at` on where that is asked for. Returns how many there are.
uint walkLoop(uint p, uint at, bool writes) {
    uint start = uint(rim_sum[p]), t = start, count = 0u, before = CORNERS, first = CORNERS;
    for (uint turn = 0u; turn < CORNERS && t < CORNERS; turn++) {
        uint v = slots[t];
        bool fresh = v != before && v != first;
        if (fresh && writes) loose_colliders[at + count] = vertexRank(v);
        count += fresh ? 1u : 0u;
        first = first == CORNERS ? v : first;
        before = v;
        t = followerOf(p, planeBefore(t, p));
        t = t == start ? CORNERS : t;
    }
    return count;
}

void countLoops(uint lane) {
    for (uint p = lane; p < PLANES; p += LANES) {
        bool live = livePlane(p) && rim_sum[p] < CORNERS;
        uint size = live ? walkLoop(p, 0u, false) : 0u;
        rim_squares[p] = size >= 3u ? int(size) : 0;
        if (size >= 3u) atomicOr(face_mask[p >> 5], 1u << (p & 31u));
    }
    for (uint t = lane; t < corner_top; t += LANES) {
        if (liveCorner(t)) atomicOr(vertex_mask[slots[t] >> 5], 1u << (slots[t] & 31u));
    }
    barrier();
}

uint loopStart(uint p) {
    uint at = 0u;
    for (uint q = 0u; q < p; q++) at += uint(rim_squares[q]);
    return at;
}

void writeFace(uint p, uint base) {
    uint face = planesBefore(p, face_mask), start = loopStart(p), at = base + 4u + COLLIDER_FACE_WORDS * face;
    Plane e = planeAt(p);
    precise float size = length(vec3(e.d));
    precise vec3 n = vec3(e.d) / size;
    precise float height = (longToFloat(e.r) / (2.0 * size) + dot(n, vec3(inTile(site) - ivec3(kGridMiddle)))) * step_size;
    loose_colliders[at] = floatBitsToUint(n.x);
    loose_colliders[at + 1u] = floatBitsToUint(n.y);
    loose_colliders[at + 2u] = floatBitsToUint(n.z);
    loose_colliders[at + 3u] = floatBitsToUint(height);
    loose_colliders[at + 4u] = start;
    loose_colliders[at + 5u] = e.id;
    walkLoop(p, base + COLLIDER_LOOPS_AT + start, true);
}

void writeVertices(uint lane, uint base) {
    for (uint t = lane; t < corner_top; t += LANES) {
        if (liveCorner(t) && slots[t] == t) {
            uint at = base + COLLIDER_VERTICES_AT + 3u * vertexRank(t);
            vec3 place = corner_place[t].xyz;
            loose_colliders[at] = floatBitsToUint(place.x);
            loose_colliders[at + 1u] = floatBitsToUint(place.y);
            loose_colliders[at + 2u] = floatBitsToUint(place.z);
        }
    }
}

uint facesLeft() { return uint(bitCount(face_mask[0]) + bitCount(face_mask[1])); }

uint verticesLeft() {
    uint vertices = 0u;
    for (uint m = 0u; m < ROLLED(CORNER_MASKS); m++) vertices += uint(bitCount(vertex_mask[m]));
    return vertices;
}

void nameVertices(uint lane) {
    bool is_ball = false;
    for (uint attempt = 0u; attempt < 2u && !is_ball; attempt++) {
        forgetLinks(lane);
        linkCorners(lane, attempt == 0u);
        countLoops(lane);
        is_ball = 2u * (verticesLeft() + facesLeft()) == loopStart(PLANES) + 4u;
        barrier();
    }
}

void writeCollider(uint lane) {
    countPlanes(lane, true);
    placeCorners(lane);
    nameVertices(lane);
    uint base = fragment * COLLIDER_WORDS;
    for (uint p = lane; p < PLANES; p += LANES) {
        if (rim_squares[p] != 0) writeFace(p, base);
    }
    writeVertices(lane, base);
    if (lane != 0u) return;
    uvec3 sizes = uvec3(facesLeft(), verticesLeft(), loopStart(PLANES));
    loose_colliders[base] = sizes.x;
    loose_colliders[base + 1u] = sizes.y;
    loose_colliders[base + 2u] = sizes.z;
    loose_colliders[base + 3u] = lacks;
    collider_sizes[fragment] = uvec4(sizes, 0u);
}
