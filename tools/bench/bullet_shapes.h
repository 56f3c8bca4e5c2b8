// The shapes of a world's bodies, as Bullet has them. Only for files of a build that has Bullet.
#pragma once

#include "modules/brittle/dynamics/world_contents.h"
#include "tools/bench/bullet_types.h"

#include <memory>
#include <vector>

namespace bench {

// Boxes are btBoxShape, fixed triangles one btBvhTriangleMeshShape, bodies of several pieces btCompoundShape of hulls. A plane
// is the upper side of a btBoxShape, since on btStaticPlaneShape fewer cases pass. That box is 100 m wide, or 4000 radii of the
// largest body if that is less: in floats a wider one is too coarse for bodies of millimeters.
//
// The margin is 1 mm, and at most 2 % of the thinnest piece; Bullet's default of 40 mm is larger than many of these bodies. A
// btConvexHullShape has its margin around it. So a hull is drawn in by the margin first, and with it is as large as the body.
class BulletShapes {
public:
    explicit BulletShapes(const brittle::WorldContents& contents);

    // Of a body of the contents, in its frame. It lives as long as this object.
    btCollisionShape* shapeOf(size_t body);
    // Where the middle of that shape is, in the body's frame.
    Point middleOf(size_t body) const;
    // m. Half of the body's least extent along its own axes.
    double halfExtent(size_t body) const;

private:
    std::vector<Point> cornersOf(size_t piece) const;
    bool isPlane(size_t body) const;
    bool isSurface(size_t body) const; // of triangles
    double marginOf(size_t body) const;
    std::unique_ptr<btCollisionShape> makeShape(size_t body);
    std::unique_ptr<btCollisionShape> surfaceOf(size_t body);
    std::unique_ptr<btCollisionShape> hullOf(size_t piece, double margin) const;
    std::unique_ptr<btCollisionShape> compoundOf(size_t body);

    const brittle::WorldContents& contents_;
    double half_ground_; // m
    std::vector<std::unique_ptr<btTriangleMesh>> meshes_;
    std::vector<std::unique_ptr<btCollisionShape>> shapes_; // also those that others are made of
};

} // namespace bench
