#include "tests/module/collided.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace whole {
namespace {

using brittle::ColliderSet;
using brittle::FragmentSet;
using reference::Convex;
using reference::Point;
using reference::operator+; // of arrays, which argument-dependent lookup does not find

constexpr double kSteps = 6; // of the grid

Point pointOf(const brittle::Float3& p) { return {p[0], p[1], p[2]}; }

void expectHoldsFragment(const FragmentSet& set, uint32_t f, const Convex& solid, double tolerance) {
    const brittle::Fragment& fragment = set.fragments[f];
    double furthest = 0;
    for (uint32_t k = 0; k < fragment.vertex_count; ++k) {
        const float* p = set.vertices[fragment.first_vertex + k].position;
        furthest = std::max(furthest, reference::distanceOutside(solid, {p[0], p[1], p[2]}));
    }
    EXPECT_LE(furthest, tolerance) << "fragment " << f << " sticks out";
}

void expectInCell(const brittle::FractureResult& result, uint32_t cell, const Convex& solid, double tolerance) {
    const Point center = result.fragments.center;
    double furthest = 0;
    for (const Point& p : solid.vertices)
        furthest = std::max(furthest, reference::distanceOutsideCell(result.sites, cell, p + center));
    EXPECT_LE(furthest, tolerance) << "the piece of cell " << cell << " reaches out of it";
}

reference::Bounds boundsOf(const Convex& solid) {
    reference::Bounds bounds;
    for (const Point& p : solid.vertices)
        bounds.grow(p);
    return bounds;
}

bool boxesMeet(const reference::Bounds& a, const reference::Bounds& b) {
    bool meet = true;
    for (size_t k = 0; k < 3; ++k)
        meet = meet && a.lower[k] <= b.upper[k] && b.lower[k] <= a.upper[k];
    return meet;
}

void expectApart(const ColliderSet& colliders, const std::vector<Convex>& solids, double tolerance) {
    std::vector<reference::Bounds> bounds;
    bounds.reserve(solids.size());
    for (const Convex& solid : solids)
        bounds.push_back(boundsOf(solid));
    for (uint32_t a = 0; a < solids.size(); ++a) {
        for (uint32_t b = a + 1; b < solids.size(); ++b) {
            const bool listed = std::ranges::binary_search(colliders.overlapping, std::array<uint32_t, 2>{a, b});
            if (listed || !boxesMeet(bounds[a], bounds[b])) continue;
            EXPECT_LE(reference::overlapOf(solids[a], solids[b]), tolerance) << "pieces " << a << " and " << b << " overlap";
        }
    }
}

} // namespace

Convex convexOf(const ColliderSet& colliders, uint32_t piece) {
    const brittle::ColliderPiece& from = colliders.pieces[piece];
    Convex solid;
    for (uint32_t k = 0; k < from.vertex_count; ++k)
        solid.vertices.push_back(pointOf(colliders.vertices[from.first_vertex + k]));
    for (uint32_t k = 0; k < from.face_count; ++k) {
        const brittle::ColliderFace& face = colliders.faces[from.first_face + k];
        const auto first = colliders.corners.begin() + face.first_corner;
        solid.faces.push_back({pointOf(face.normal), face.height, {first, first + face.corner_count}});
    }
    return solid;
}

double reachOf(const Model& model) {
    double reach = 0;
    for (const brittle::Float3& p : model.prepared.mesh.positions)
        for (float x : p)
            reach = std::max(reach, std::fabs(static_cast<double>(x)));
    return reach;
}

brittle::FractureResult brokenWith(uint32_t directions, const Model& model, brittle::FractureOptions options) {
    options.collider = directions;
    auto result = fracture().shatter(model.prepared.mesh, model.prepared.topology, options);
    EXPECT_TRUE(result) << result.error().message;
    return result ? std::move(*result) : brittle::FractureResult{};
}

void expectColliders(const Model& model, const brittle::FractureResult& result) {
    const FragmentSet& set = result.fragments;
    const double tolerance = kSteps * reachOf(model) * 0x1p-22;
    ASSERT_EQ(set.colliders.pieces.size(), set.fragments.size());
    std::vector<Convex> solids;
    for (uint32_t f = 0; f < set.fragments.size(); ++f) {
        SCOPED_TRACE("fragment " + std::to_string(f));
        const Convex& solid = solids.emplace_back(convexOf(set.colliders, f));
        EXPECT_EQ(set.colliders.pieces[f].cell, set.fragments[f].cell);
        EXPECT_EQ(reference::defectOf(solid, tolerance), "");
        expectHoldsFragment(set, f, solid, tolerance);
        expectInCell(result, set.fragments[f].cell, solid, tolerance);
    }
    expectApart(set.colliders, solids, tolerance);
}

double excessOf(const FragmentSet& set) {
    double fragments = 0, pieces = 0;
    for (uint32_t f = 0; f < set.fragments.size(); ++f) {
        fragments += set.fragments[f].volume;
        pieces += reference::volumeOf(convexOf(set.colliders, f));
    }
    return pieces / fragments - 1;
}

} // namespace whole
