// Small solids for tests, as plain triangles.
#pragma once

#include "tests/reference/geometry.h"
#include "tests/reference/glb_file.h"

namespace support {

// Twelve triangles, outward; the first two are the face at lower[0], the next two the one at upper[0], then y, then z.
reference::Triangles boxTriangles(const reference::Point& lower, const reference::Point& upper);

// The same triangles walked the other way round.
reference::Triangles turnedOver(const reference::Triangles& triangles);

reference::Triangles joined(reference::Triangles first, const reference::Triangles& second);

// The box (0,0,0)-(2,1,1), broken at x = 1 as a fragment file would tell it; frame at (10, 20, 30).
struct BrokenBox {
    reference::Triangles model;
    reference::FragmentFile file;
};
BrokenBox brokenBox();

} // namespace support
