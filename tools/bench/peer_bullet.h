// Bullet (libbullet-dev) beside us: rigid bodies and its broad phase, in floats, on one thread, as its users set it up. Nothing
// of it is in the module.
#pragma once

#include "tools/bench/inputs.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace bench {

// One convex piece about its center of mass, along its principal axes.
struct SolidBody {
    std::vector<Point> corners;
    double mass = 0;           // kg; 0: it does not move
    Point moments = {0, 0, 0}; // kg m2
    Point place = {0, 0, 0};
    std::array<double, 4> turn = {0, 0, 0, 1}; // x, y, z, w
    Point velocity = {0, 0, 0}, spin = {0, 0, 0};
    double friction = 0, restitution = 0; // of two bodies the geometric mean and the greater one count, as with us
};

struct BodyMotion {
    Point place = {0, 0, 0};
    std::array<double, 4> turn = {0, 0, 0, 1};
    Point velocity = {0, 0, 0}, spin = {0, 0, 0};
};

class BulletWorld {
public:
    // Hulls are as large as they are and get the margin around them, which is how Bullet's users have it (its default is
    // 0.04 m); boxes that do not move are boxes and have it inside. Nobody sleeps. Null where Bullet is not in the build.
    static std::unique_ptr<BulletWorld> create(std::span<const SolidBody> bodies, const Point& gravity, double margin);
    virtual ~BulletWorld() = default;

    virtual void step(double dt, uint32_t steps) = 0;
    virtual std::vector<BodyMotion> motions() const = 0;
};

struct BoxOfSpace {
    Point low = {0, 0, 0}, high = {0, 0, 0};
};

// Its dynamic trees (btDbvtBroadphase), which it keeps from step to step, and with them the pairs.
class BulletBoxes {
public:
    static std::unique_ptr<BulletBoxes> create(); // null where Bullet is not in the build
    virtual ~BulletBoxes() = default;

    // Milliseconds of making all boxes anew and finding their pairs.
    virtual double build(std::span<const BoxOfSpace> boxes) = 0;
    // Milliseconds of moving every box to where it is now and bringing the pairs up to date.
    virtual double move(std::span<const BoxOfSpace> boxes) = 0;
    virtual size_t pairCount() const = 0;
};

} // namespace bench
