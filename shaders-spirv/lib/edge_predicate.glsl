// Sign of D_l where D_j = 0 on a mesh edge, in the cell of i: degree 4, 102 bits. Ties by simulation of simplicity: the
// weights enter linearly, and the coefficient of l's weight is the slope of D_j, which is not 0 where a crossing exists.
int edgeSign(uint i, uint j, uint l, int64_t ja, int64_t jb, int64_t la, int64_t lb) {
    int slope = signOf(ja - jb);
    if (!kExact) return realSign(real(ja) * real(lb) - real(jb) * real(la)) * slope;
    int sign = wideSign(wideMinor(ja, jb, la, lb));
    int64_t sj = jb - ja, sl = lb - la;
    uint lowest = NO_INDEX;
    int verdict = 0;
    int ci = signOf(sl - sj), cj = -signOf(sl), cl = signOf(sj);
    if (ci != 0) { lowest = i; verdict = ci; }
    if (cj != 0 && j < lowest) { lowest = j; verdict = cj; }
    if (cl != 0 && l < lowest) { lowest = l; verdict = cl; }
    return (sign != 0 ? sign : verdict) * slope;
}
