// Sign of D_l at a vertex of a clipped triangle, in the cell of i: degree 6, 153 bits.
//
// A vertex is where two lines cross in the triangle's plane; a line is a row of three corner values: those of D_j for a
// bisector, a unit row for an edge of the triangle (where one barycentric coordinate is 0). With rows J, K and their 2x2
// minors m, the vertex is m / sum(m), and the question is sign(m . L) sign(sum m). Corners, points on edges and points inside
// are one case. Ties by simulation of simplicity: linear in the weights; l's coefficient is sum(m), never 0 at a vertex.
struct Row {
    int64_t v[3];
    uint id; // site, or EDGE_BASE + k
};

struct Minors {
    Wide128 m[3];
};

Minors minorsOf(Row j, Row k) {
    return Minors(Wide128[3](wideMinor(j.v[1], j.v[2], k.v[1], k.v[2]), wideMinor(j.v[2], j.v[0], k.v[2], k.v[0]),
                             wideMinor(j.v[0], j.v[1], k.v[0], k.v[1])));
}

Wide128 sumOf(Minors m) { return wideAdd(wideAdd(m.m[0], m.m[1]), m.m[2]); }

void weighTie(inout uint lowest, inout int verdict, uint id, int coefficient) {
    if (id < BOX_BASE - 16u && coefficient != 0 && id < lowest) {
        lowest = id;
        verdict = coefficient;
    }
}

// A row in floating point, in units that keep products of three within the range of fp32.
real3 roundedRow(Row j) { return real3(real(j.v[0]), real(j.v[1]), real(j.v[2])) * real(1.0 / 33554432.0); }

int roundedTriangleSign(Row j, Row k, Row l) {
    real3 m = cross(roundedRow(j), roundedRow(k));
    return realSign(dot(m, roundedRow(l))) * realSign(m.x + m.y + m.z);
}

int triangleSign(uint i, Row j, Row k, Row l) {
    if (!kExact) return roundedTriangleSign(j, k, l);
    Minors m = minorsOf(j, k);
    Wide128 sum = sumOf(m);
    Wide192 det = wideAdd(wideAdd(wideMul192(m.m[0], wideFrom(l.v[0])), wideMul192(m.m[1], wideFrom(l.v[1]))),
                          wideMul192(m.m[2], wideFrom(l.v[2])));
    Wide128 cj = sumOf(minorsOf(k, l)), ck = sumOf(minorsOf(l, j)); // ck already carries its sign
    Wide128 zero = Wide128(uint64_t(0), int64_t(0));
    Wide128 ci = wideAdd(wideAdd(j.id < EDGE_BASE ? cj : zero, k.id < EDGE_BASE ? ck : zero), sum);
    uint lowest = NO_INDEX;
    int verdict = 0;
    weighTie(lowest, verdict, i, wideSign(ci));
    weighTie(lowest, verdict, j.id, -wideSign(cj));
    weighTie(lowest, verdict, k.id, -wideSign(ck));
    weighTie(lowest, verdict, l.id, -wideSign(sum));
    int sign = wideSign(det);
    return (sign != 0 ? sign : verdict) * wideSign(sum);
}
