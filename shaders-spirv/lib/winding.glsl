// What a triangle adds to the winding number of a place along +z, exact, with the place moved by (eps, eps^2) in x and y against
// ties. Wants lib/wide.glsl.

// On which side of a -> b the moved point lies; 0 only where a and b fall together.
int sideOfEdge(ivec3 a, ivec3 b, ivec3 p) {
    int64_t s = int64_t(b.x - a.x) * int64_t(p.y - a.y) - int64_t(b.y - a.y) * int64_t(p.x - a.x);
    return !isZero(s) ? signOf(s) : (b.y != a.y ? sign(a.y - b.y) : sign(b.x - a.x));
}

int windingAbove(ivec3 a, ivec3 b, ivec3 c, ivec3 p) {
    int s = sideOfEdge(a, b, p);
    bool crossed = s != 0 && sideOfEdge(b, c, p) == s && sideOfEdge(c, a, p) == s;
    ivec3 u = b - a, w = c - a, d = p - a;
    int64_t nx = int64_t(u.y) * int64_t(w.z) - int64_t(u.z) * int64_t(w.y);
    int64_t ny = int64_t(u.z) * int64_t(w.x) - int64_t(u.x) * int64_t(w.z);
    int64_t nz = int64_t(u.x) * int64_t(w.y) - int64_t(u.y) * int64_t(w.x);
    int height = wideSign(wideAdd(wideAdd(wideMul(nx, int64_t(d.x)), wideMul(ny, int64_t(d.y))), wideMul(nz, int64_t(d.z))));
    return crossed && height * s < 0 ? s : 0;
}
