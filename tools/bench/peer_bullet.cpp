#include "tools/bench/peer_bullet.h"

#ifdef BRITTLE_PEER_BULLET

#include "tools/bench/bullet_types.h"

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>

#include <chrono>

namespace bench {
namespace {

Point middleOf(const std::vector<Point>& corners) {
    Point low = corners.front(), high = low;
    for (const Point& p : corners)
        for (size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], p[k]);
            high[k] = std::max(high[k], p[k]);
        }
    return {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2};
}

class World : public BulletWorld {
public:
    World(const Point& gravity, double margin)
        : dispatcher_(&configuration_), world_(&dispatcher_, &broad_phase_, &solver_, &configuration_),
          margin_(static_cast<btScalar>(margin)) {
        world_.setGravity(vectorOf(gravity));
    }
    ~World() override {
        for (const auto& body : bodies_)
            world_.removeRigidBody(body.get());
    }
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    void add(const SolidBody& body) {
        const Point shift = body.mass == 0 ? middleOf(body.corners) : Point{0, 0, 0};
        const btTransform turned = transformOf(body.place, body.turn);
        shifts_.push_back(vectorOf(shift));
        shapes_.push_back(shapeOf(body, shift));
        btRigidBody::btRigidBodyConstructionInfo made(static_cast<btScalar>(body.mass), nullptr, shapes_.back().get(),
                                                      vectorOf(body.moments));
        made.m_startWorldTransform = turned * btTransform(btQuaternion::getIdentity(), shifts_.back());
        made.m_friction = static_cast<btScalar>(std::sqrt(body.friction)); // Bullet multiplies those of two bodies
        made.m_restitution = static_cast<btScalar>(body.restitution);
        bodies_.push_back(std::make_unique<btRigidBody>(made));
        bodies_.back()->setLinearVelocity(vectorOf(body.velocity));
        bodies_.back()->setAngularVelocity(vectorOf(body.spin));
        bodies_.back()->setActivationState(DISABLE_DEACTIVATION);
        world_.addRigidBody(bodies_.back().get());
    }

    void step(double dt, uint32_t steps) override {
        for (uint32_t k = 0; k < steps; ++k)
            world_.stepSimulation(static_cast<btScalar>(dt), 0);
    }

    std::vector<BodyMotion> motions() const override {
        std::vector<BodyMotion> motions;
        for (size_t b = 0; b < bodies_.size(); ++b) {
            const btTransform& at = bodies_[b]->getWorldTransform();
            const btQuaternion turn = at.getRotation();
            motions.push_back({pointOf(at * -shifts_[b]),
                               {turn.x(), turn.y(), turn.z(), turn.w()},
                               pointOf(bodies_[b]->getLinearVelocity()),
                               pointOf(bodies_[b]->getAngularVelocity())});
        }
        return motions;
    }

private:
    std::unique_ptr<btCollisionShape> shapeOf(const SolidBody& body, const Point& shift) const {
        std::vector<Point> corners = body.corners;
        for (Point& p : corners)
            for (size_t k = 0; k < 3; ++k)
                p[k] -= shift[k];
        if (const auto half = halfOf(corners); half && body.mass == 0) return std::make_unique<btBoxShape>(*half);
        auto hull = std::make_unique<btConvexHullShape>();
        for (const Point& p : corners)
            hull->addPoint(vectorOf(p), false);
        hull->recalcLocalAabb();
        hull->setMargin(margin_);
        return hull;
    }

    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broad_phase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld world_;
    btScalar margin_;
    std::vector<std::unique_ptr<btCollisionShape>> shapes_;
    std::vector<std::unique_ptr<btRigidBody>> bodies_;
    std::vector<btVector3> shifts_; // from a body's own frame to the middle of its shape
};

double millisecondsSince(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

class Boxes : public BulletBoxes {
public:
    Boxes() : dispatcher_(&configuration_) {}
    ~Boxes() override { clear(); }
    Boxes(const Boxes&) = delete;
    Boxes& operator=(const Boxes&) = delete;

    double build(std::span<const BoxOfSpace> boxes) override {
        clear();
        const auto begin = std::chrono::steady_clock::now();
        broad_phase_ = std::make_unique<btDbvtBroadphase>();
        for (const BoxOfSpace& box : boxes)
            proxies_.push_back(broad_phase_->createProxy(vectorOf(box.low), vectorOf(box.high), BOX_SHAPE_PROXYTYPE, nullptr,
                                                         btBroadphaseProxy::DefaultFilter, btBroadphaseProxy::AllFilter,
                                                         &dispatcher_));
        broad_phase_->calculateOverlappingPairs(&dispatcher_);
        return millisecondsSince(begin);
    }

    double move(std::span<const BoxOfSpace> boxes) override {
        const auto begin = std::chrono::steady_clock::now();
        for (size_t k = 0; k < boxes.size(); ++k)
            broad_phase_->setAabb(proxies_[k], vectorOf(boxes[k].low), vectorOf(boxes[k].high), &dispatcher_);
        broad_phase_->calculateOverlappingPairs(&dispatcher_);
        return millisecondsSince(begin);
    }

    size_t pairCount() const override {
        return static_cast<size_t>(broad_phase_->getOverlappingPairCache()->getNumOverlappingPairs());
    }

private:
    void clear() {
        for (btBroadphaseProxy* proxy : proxies_)
            broad_phase_->destroyProxy(proxy, &dispatcher_);
        proxies_.clear();
    }

    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    std::unique_ptr<btDbvtBroadphase> broad_phase_;
    std::vector<btBroadphaseProxy*> proxies_;
};

} // namespace

std::unique_ptr<BulletWorld> BulletWorld::create(std::span<const SolidBody> bodies, const Point& gravity, double margin) {
    auto world = std::make_unique<World>(gravity, margin);
    for (const SolidBody& body : bodies)
        world->add(body);
    return world;
}

std::unique_ptr<BulletBoxes> BulletBoxes::create() { return std::make_unique<Boxes>(); }

} // namespace bench

#else

namespace bench {

std::unique_ptr<BulletWorld> BulletWorld::create(std::span<const SolidBody>, const Point&, double) { return nullptr; }
std::unique_ptr<BulletBoxes> BulletBoxes::create() { return nullptr; }

} // namespace bench

#endif
