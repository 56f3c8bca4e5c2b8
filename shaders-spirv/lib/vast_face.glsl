// A vast face: a cut face of more sides than a workgroup holds in its own memory. Its kernels have a lane for each side, or for
// each half-edge, of all vast faces.
//
// The method is Seidel's (1991): trapezoids between the corners of the outline give diagonals, and these part it into mountains,
// polygons whose corners lie in order of height beside one long edge. Each corner of a mountain that turns left is an ear, so
// nothing has to be tested against the rest of the outline.
//
// Diagonals are added to the outline as pairs of half-edges, and each half-edge has one that follows it. So the triangles have
// the sides of the outline for their own outline, whatever rounding has done to its corners.
//
// Half-edge VAST_HALVES * k is side k; the four behind it are the halves of the two diagonals that begin at its corner.
struct VastFace {
    uint index; // among the faces that carry caps
    uint first; // side
    uint count;
    uint pad;
};
