#ifdef BRITTLE_PEER_BULLET

#include "tools/bench/bullet_shapes.h"

#include "tests/support/body_overlaps.h"
#include "tests/support/inset_hull.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace bench {
namespace {

constexpr double kMargin = 1e-3;                            // m
constexpr double kMarginShare = 0.02;                       // of the thinnest piece
constexpr double kMostHalfGround = 50, kGroundShare = 2000; // m; radii of the largest body
constexpr double kRounding = 1e-6;                          // of a box of floats

double halfGroundOf(const brittle::WorldContents& contents) {
    double largest = 0;
    for (size_t b = 0; b < contents.bodies.size(); ++b)
        if (contents.bodies[b].offset.w != 0) largest = std::max(largest, double{contents.shapes[b].inverse_inertia[2].w});
    return std::min(kMostHalfGround, kGroundShare * largest);
}

} // namespace

BulletShapes::BulletShapes(const brittle::WorldContents& contents)
    : contents_(contents), half_ground_(halfGroundOf(contents)) {}

btCollisionShape* BulletShapes::shapeOf(size_t body) {
    auto shape = makeShape(body);
    shape->setMargin(static_cast<btScalar>(marginOf(body)));
    return shapes_.emplace_back(std::move(shape)).get();
}

Point BulletShapes::middleOf(size_t body) const { return {0, isPlane(body) ? -half_ground_ : 0, 0}; }

double BulletShapes::halfExtent(size_t body) const {
    const gpu::uvec4& pieces = contents_.shapes[body].pieces;
    reference::Bounds bounds;
    for (uint32_t p = pieces.x; p < pieces.x + pieces.y; ++p)
        for (const Point& corner : cornersOf(p))
            bounds.grow(corner);
    double thinnest = std::numeric_limits<double>::infinity();
    for (size_t k = 0; k < 3; ++k)
        thinnest = std::min(thinnest, bounds.upper[k] - bounds.lower[k]);
    return thinnest / 2;
}

std::vector<Point> BulletShapes::cornersOf(size_t piece) const { return support::pieceInWorld(contents_, piece, {}).vertices; }

bool BulletShapes::isPlane(size_t body) const {
    return (contents_.pieces[contents_.shapes[body].pieces.x].ids.z & PIECE_PLANE) != 0;
}

bool BulletShapes::isSurface(size_t body) const {
    const gpu::HullRecord& hull = contents_.hulls.records[contents_.pieces[contents_.shapes[body].pieces.x].ids.x];
    return hull.count.x == 3;
}

// Triangles have no thickness.
double BulletShapes::marginOf(size_t body) const {
    const double thickness = 2.0 * std::bit_cast<float>(contents_.shapes[body].pieces.z);
    return isSurface(body) ? kMargin : std::min(kMargin, kMarginShare * thickness);
}

std::unique_ptr<btCollisionShape> BulletShapes::makeShape(size_t body) {
    const gpu::uvec4& pieces = contents_.shapes[body].pieces;
    if (isPlane(body)) return std::make_unique<btBoxShape>(vectorOf({half_ground_, half_ground_, half_ground_}));
    if (isSurface(body)) return surfaceOf(body);
    if (pieces.y > 1) return compoundOf(body);
    if (const auto half = halfOf(cornersOf(pieces.x), kRounding)) return std::make_unique<btBoxShape>(*half);
    return hullOf(pieces.x, marginOf(body));
}

std::unique_ptr<btCollisionShape> BulletShapes::surfaceOf(size_t body) {
    const gpu::uvec4& pieces = contents_.shapes[body].pieces;
    auto& mesh = *meshes_.emplace_back(std::make_unique<btTriangleMesh>());
    for (uint32_t p = pieces.x; p < pieces.x + pieces.y; ++p) {
        const std::vector<Point> corners = cornersOf(p);
        mesh.addTriangle(vectorOf(corners[0]), vectorOf(corners[1]), vectorOf(corners[2]));
    }
    return std::make_unique<btBvhTriangleMeshShape>(&mesh, true);
}

std::unique_ptr<btCollisionShape> BulletShapes::hullOf(size_t piece, double margin) const {
    auto hull = std::make_unique<btConvexHullShape>();
    for (const Point& corner : support::insetCorners(support::pieceInWorld(contents_, piece, {}), margin))
        hull->addPoint(vectorOf(corner), false);
    hull->setMargin(static_cast<btScalar>(margin));
    hull->recalcLocalAabb();
    return hull;
}

std::unique_ptr<btCollisionShape> BulletShapes::compoundOf(size_t body) {
    const gpu::uvec4& pieces = contents_.shapes[body].pieces;
    auto compound = std::make_unique<btCompoundShape>();
    for (uint32_t p = pieces.x; p < pieces.x + pieces.y; ++p) {
        shapes_.push_back(hullOf(p, marginOf(body)));
        compound->addChildShape(btTransform::getIdentity(), shapes_.back().get());
    }
    return compound;
}

} // namespace bench

#endif
