// How much less crack a blow leaves in an oblong plate than in a square one that is hit at the same place of it, for as many sites.
//
// Sites lie as r^(-4/3) about the blow, and cracks are as long as the integral of the root of their density (fragment_count.h). In
// polar coordinates about the blow, R being how far it is to the rim, with A the area:
//   crack ~ I / sqrt(D A),   I = 3/4 of the integral of R^(4/3) over all directions,   D = 3/2 of that of R^(2/3)
// which is 0.864 for a square that is hit in the middle, 0.68 for a strip of 7.5 : 1 that is hit at an end, where a square has 0.83.
const uint kDirections = 256u;

float crackIn(vec2 edges, vec2 off) {
    float sites = 0.0, cracks = 0.0;
    for (uint k = 0u; k < kDirections; k++) {
        float angle = (float(k) + 0.5) * 6.2831853 / float(kDirections);
        vec2 way = vec2(cos(angle), sin(angle)), left = max(0.5 * edges - sign(way) * off, 0.0) / max(abs(way), 1e-6);
        float reach = pow(min(left.x, left.y), 1.0 / 3.0);
        sites += reach * reach;
        cracks += reach * reach * reach * reach;
    }
    return cracks * inversesqrt(max(sites * edges.x * edges.y, 1e-30));
}

// `off`: from the middle, along the edges.
float crowdedIn(vec2 edges, vec2 off) {
    vec2 inside = clamp(off, -0.5 * edges, 0.5 * edges);
    return crackIn(edges, inside) / max(crackIn(vec2(1.0), inside / edges), 1e-6);
}
