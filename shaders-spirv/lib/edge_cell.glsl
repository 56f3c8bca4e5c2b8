// A Voronoi cell while a workgroup cuts it in fp32, a lane an edge (the paper, section 3 and listing 2).
//
// An edge has a face to its left and one to its right, seen from outside on the way from one end to the other, and ends at two
// corners. Cutting by e, a lane sees from the two ends whether its edge stays, goes, or is clipped and ends at a new corner on
// e. Around every face the edges run counterclockwise: where a cut leaves the face, at one new corner, and where it comes
// back, at another, the face gets a new edge between the two, with e to its right. So new corners are joined by the plane
// that they have in common, and nothing is walked along.
//
// Walls of the box are mirrored sites, as in lib/fast_cell.glsl, and the bounds of errors are the same.
//
// Edges and corners that are left stand in their old order, new ones behind them: their places are prefix sums, and they are
// written to the other of two copies.
// Wants lib/edge_store.glsl and lib/group_search.glsl.

uint leftOf(uint edge) { return edge & 0xffu; }
uint rightOf(uint edge) { return (edge >> 8) & 0xffu; }
uint fromOf(uint edge) { return (edge >> 16) & 0xffu; }
uint toOf(uint edge) { return edge >> 24; }
uint packEdge(uint left, uint right, uint from, uint to) { return left | (right << 8) | (from << 16) | (to << 24); }

// Corner k of the box has the upper wall along every axis whose bit is set.
void startCorner(uint k, vec3 low, vec3 high) {
    bvec3 upper = bvec3((k & 1u) != 0u, (k & 2u) != 0u, (k & 4u) != 0u);
    uint x = k & 1u, y = 2u + ((k >> 1) & 1u), z = 4u + (k >> 2);
    bool odd = upper.x != (upper.y != upper.z);
    vec3 w = mix(low, high, upper);
    corner_copies[0][k] = vec4(w, kTestError * sumOfSizes(w));
    triple_copies[0][k] = x | ((odd ? y : z) << 8) | ((odd ? z : y) << 16);
}

// Edge k runs along axis k / 4, between a wall of the next axis and one of the axis after that.
void startEdge(uint k) {
    uint axis = k >> 2, s = k & 1u, t = (k >> 1) & 1u, u = (axis + 1u) % 3u, v = (axis + 2u) % 3u;
    uint first = 2u * u + s, second = 2u * v + t, from = (s << u) | (t << v);
    edge_copies[0][k] = packEdge(s == t ? first : second, s == t ? second : first, from, from | (1u << axis));
}

void startCell(uint lane, ivec3 site, ivec3 box_low, ivec3 box_high) {
    vec3 low = vec3(2 * (box_low - site)), high = vec3(2 * (box_high - site));
    if (lane < 6u) {
        vec3 d = vec3(0.0);
        d[lane >> 1] = (lane & 1u) != 0u ? high[lane >> 1] : low[lane >> 1];
        plane_d[lane] = vec4(d, 0.0);
        plane_id[lane] = BOX_BASE + lane;
    }
    if (lane < 8u) startCorner(lane, low, high);
    if (lane < 12u) startEdge(lane);
    if (lane == 0u) trouble = 0u;
    startSearch(lane);
    copy = 0u;
    edge_count = 12u;
    corner_top = 8u;
    plane_count = 6u;
    sync();
}

uint edgeTurns() { return edge_count / LANES + 1u; }

#ifdef DOUBLES
bool cutsInDoubles(uint planes, vec3 e) {
    RoundedPlane a = roundedBisector(real3(plane_d[planes & 0xffu].xyz)), b = roundedBisector(real3(plane_d[(planes >> 8) & 0xffu].xyz));
    return roundedCuts(a, b, roundedBisector(real3(plane_d[planes >> 16].xyz)), roundedBisector(real3(e)));
}
#endif

// Which corners go, whether any does, and whether any is in question.
void lookAtCorners(uint lane, vec3 e) {
    float size = length(e), square = dot(e, e);
    uint turns = cornerTurns();
    for (uint k = 0u; k < turns; k++) {
        uint t = k * LANES + lane;
        vec4 c = corner_place[min(t, corner_top - 1u)];
        float beyond = dot(c.xyz, e) - square, error = kFast ? 0.0 : size * c.w + square * kTestError;
        bool goes = beyond > error, in_doubt = !kFast && beyond >= -error && !goes;
#ifdef DOUBLES
        goes = goes || (in_doubt && cutsInDoubles(triple_copies[copy][min(t, corner_top - 1u)], e));
        in_doubt = false;
#endif
        if (onCorner(t)) corner_goes[t] = goes ? 1u : 0u;
        if (onCorner(t) && goes) removed_count = 1u;
        if (onCorner(t) && in_doubt) open_count = 1u;
    }
    spend(turns);
    sync();
}

struct Tally { // packed in one word a lane, so that one prefix sum does for all
    uint corners, edges, clipped;
};
Tally tallyOf(uint word) { return Tally(word & 0x3ffu, (word >> 10) & 0x3ffu, word >> 20); }

bool goesFrom(uint edge) { return corner_goes[fromOf(edge)] == 1u; }
bool goesTo(uint edge) { return corner_goes[toOf(edge)] == 1u; }

// What stays of this lane's corners and edges, which stand in a row.
uint countStaying(uint lane) {
    uint sum = 0u, corner_turns = cornerTurns(), edge_turns = edgeTurns();
    for (uint k = 0u; k < corner_turns; k++) {
        uint t = lane * corner_turns + k;
        if (onCorner(t) && corner_goes[min(t, CORNERS - 1u)] == 0u) sum += 1u;
    }
    for (uint k = 0u; k < edge_turns; k++) {
        uint t = lane * edge_turns + k, edge = edge_copies[copy][min(t, edge_count - 1u)];
        bool from = goesFrom(edge), to = goesTo(edge);
        if (t < edge_count && !(from && to)) sum += 1u << 10;
        if (t < edge_count && from != to) sum += 1u << 20;
    }
    return sum;
}

// One that goes keeps a 1 that no place can be mistaken for: places are marked.
#define STAYS 0x100u

void moveCorners(uint lane, uint first) {
    uint turns = cornerTurns();
    for (uint k = 0u; k < turns; k++) {
        uint t = lane * turns + k, at = min(t, CORNERS - 1u);
        if (onCorner(t) && corner_goes[at] == 0u) {
            corner_copies[1u - copy][first] = corner_copies[copy][at];
            triple_copies[1u - copy][first] = triple_copies[copy][at];
            corner_goes[at] = STAYS | first;
            first++;
        }
    }
    for (uint p = lane; p < PLANES; p += LANES) entry[p] = 0u;
}

// Of planes in the order in which their normals make a positive volume.
void makeCorner(uint slot, uint a, uint b, uint c) {
    vec3 da = plane_d[a].xyz, db = plane_d[b].xyz, dc = plane_d[c].xyz;
    vec3 across = cross(da, db);
    float sa = length(da), sb = length(db), sc = length(dc), inverse = 1.0 / dot(dc, across);
    vec3 w = (dot(db, db) * cross(dc, da) - dot(da, da) * cross(dc, db) + dot(dc, dc) * across) * inverse;
    float size = length(w);
    float error = kFast ? 0.0 : kCornerError * sa * sb * sc * abs(inverse) * (sa + sb + sc + size) + kTestError * sumOfSizes(w);
    corner_copies[1u - copy][slot] = vec4(w, error);
    triple_copies[1u - copy][slot] = a | (b << 8) | (c << 16);
    if (!(error < kMaxRelativeError * size)) trouble = 1u;
}

// Edges that stay, whole or clipped, and the new corners. Left of an edge the rim comes in at `from`, right of it at `to`.
void moveEdges(uint lane, Tally at, uint staying_corners) {
    uint turns = edgeTurns();
    for (uint k = 0u; k < turns; k++) {
        uint t = lane * turns + k, edge = edge_copies[copy][min(t, edge_count - 1u)];
        bool from = goesFrom(edge), to = goesTo(edge), stays = t < edge_count && !(from && to), clipped = stays && from != to;
        uint slot = staying_corners + at.clipped, left = leftOf(edge), right = rightOf(edge);
        if (clipped) {
            makeCorner(slot, from ? right : left, from ? left : right, plane_count);
            atomicAdd(entry[from ? left : right], ENTERED + slot);
        }
        if (stays)
            edge_copies[1u - copy][at.edges] = packEdge(left, right, from ? slot : corner_goes[fromOf(edge)] & 0xffu,
                                                        to ? slot : corner_goes[toOf(edge)] & 0xffu);
        at.edges += stays ? 1u : 0u;
        at.clipped += clipped ? 1u : 0u;
    }
}

// Every clipped edge leads its face out to the new one, at its new corner.
void joinNewCorners(uint lane, Tally at, Tally total) {
    uint turns = edgeTurns();
    for (uint k = 0u; k < turns; k++) {
        uint t = lane * turns + k, edge = edge_copies[copy][min(t, edge_count - 1u)];
        bool from = goesFrom(edge), clipped = t < edge_count && from != goesTo(edge);
        uint face = from ? rightOf(edge) : leftOf(edge), back = entry[face];
        if (clipped) {
            edge_copies[1u - copy][total.edges + at.clipped] =
                packEdge(face, plane_count, total.corners + at.clipped, back & 0xffu);
            if (back / ENTERED != 1u) trouble = 1u;
        }
        at.clipped += clipped ? 1u : 0u;
    }
}

// After lookAtCorners(e).
void cutBy(uint lane, vec3 e, uint id) {
    uint before = sumBefore(lane, countStaying(lane));
    Tally at = tallyOf(before), total = tallyOf(lane_sum[LANES - 1]);
    uint corners = total.corners + total.clipped, edges = total.edges + total.clipped;
    bool fits = plane_count + 1u < PLANES && corners <= CORNERS && edges <= EDGES;
    if (!fits) status = CELL_OVERFLOW;
    if (!fits) return;
    if (lane == 0u) {
        plane_d[plane_count] = vec4(e, 0.0);
        plane_id[plane_count] = id;
    }
    moveCorners(lane, at.corners);
    sync();
    moveEdges(lane, at, total.corners);
    sync();
    joinNewCorners(lane, at, total);
    spend(2u * cornerTurns() + 3u * edgeTurns());
    sync();
    if (trouble != 0u || corners < 4u) status = CELL_UNDECIDED;
    copy = 1u - copy;
    corner_top = corners;
    edge_count = edges;
    plane_count++;
}
