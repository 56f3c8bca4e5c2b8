// Convex hulls of points: what bodies that are convex collide with, and what they weigh.
//
// The hull itself is Qhull's work (Barber, Dobkin and Huhdanpaa 1996, the quickhull algorithm). Around it stands what a body
// needs and a hull library leaves to its user: points that bound no solid are refused by name, points that are one by rounding
// are joined and counted, faces are flat, their loops closed, and there are never more of them than a body may have.
#pragma once

#include "engine/result.h"
#include "modules/brittle/mesh/mesh.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace brittle {

// What collision takes of one hull. 64 faces have at most 124 vertices and 186 edges (Euler, three edges a vertex).
constexpr uint32_t kMaxHullFaces = 64, kMaxHullVertices = 124, kMaxHullEdges = 186;

// Lengths in parts of the diagonal of the points' box. Nearer points are one; faces whose planes differ by less are one; what
// is thinner is flat. A float has 24 bits: coordinates that went through one are off by a sixteenth of this at most.
constexpr double kHullTolerance = 1e-6;
constexpr double kFaceDepth = 10; // in tolerances: no corner of a face lies further below its plane

struct ConvexHull {
    struct Face {
        Double3 normal = {0, 0, 0};                  // outward, unit
        double height = 0;                           // along the normal; no vertex lies beyond it
        uint32_t first_corner = 0, corner_count = 0; // in `corners`, counterclockwise seen from outside
    };
    struct Edge {
        uint32_t from = 0, to = 0;    // vertices, from < to
        uint32_t left = 0, right = 0; // faces: the loop of `left` runs from -> to, that of `right` back
    };
    std::vector<Double3> vertices; // of the points given, in their order; in the points' own frame
    std::vector<Face> faces;
    std::vector<uint32_t> corners; // vertices
    std::vector<Edge> edges;       // each once, in order of (from, to)
};

// Of a solid of density 1 kg/m3, by the divergence theorem.
struct HullMeasures {
    double volume = 0;                                  // m3, and so the mass in kg
    Double3 center = {0, 0, 0};                         // of mass, in the hull's frame
    std::array<double, 6> inertia = {0, 0, 0, 0, 0, 0}; // tensor about the center, kg m2: xx, yy, zz, xy, xz, yz
};

struct HullNotes {
    uint32_t joined = 0;   // points nearer to an earlier one than the tolerance, which stands for both
    double loosened = 0;   // m: how far the hull reaches beyond the points' own, 0 unless it had too many faces
    uint32_t faces_in = 0; // how many it had then
};

struct PointHull {
    ConvexHull hull;
    HullMeasures measures; // of the points' own hull, also where `hull` is a looser one
    HullNotes notes;
    std::vector<std::string> reader_notes; // of a file's hull: what its reader left out
};

// The hull of any number of points, with at most kMaxHullFaces faces and kMaxHullVertices vertices. One that has more is
// replaced by a solid of 64 planes or fewer that holds it (hull_simplify.h) and `notes` tell how far it reaches beyond.
// Errors, all BadInput, begin with the reason's name: "not finite", "too few points", "coincident points", "collinear points",
// "coplanar points", "too large".
engine::Result<PointHull> hullOfPoints(std::span<const Double3> points);

// The same without a limit of faces: as many as the points call for.
engine::Result<PointHull> fullHullOfPoints(std::span<const Double3> points);

HullMeasures measure(const ConvexHull& hull);

} // namespace brittle
