#include "tools/bench/bullet_mover.h"

#ifdef BRITTLE_PEER_BULLET

#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/dynamics/scene_settings.h"
#include "tools/bench/bullet_shapes.h"

#include <BulletCollision/CollisionDispatch/btManifoldResult.h>

namespace bench {
namespace {

using engine::Error, engine::ErrorCode, engine::Result;

// Bullet multiplies those of two bodies.
btScalar greaterRestitution(const btCollisionObject* a, const btCollisionObject* b) {
    return std::max(a->getRestitution(), b->getRestitution());
}

Point xyz(const gpu::vec4& v) { return {v.x, v.y, v.z}; }

gpu::vec4 packed(const Point& p, float w) {
    return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]), w};
}

Point principalMoments(const gpu::BodyShape& shape) {
    return {1.0 / shape.inverse_inertia[0].x, 1.0 / shape.inverse_inertia[1].y, 1.0 / shape.inverse_inertia[2].z};
}

class BulletMover : public support::Mover {
public:
    BulletMover(const brittle::StepSettings& settings, const brittle::WorldContents& contents)
        : settings_(settings), contents_(contents), shapes_(contents), dispatcher_(&configuration_),
          world_(&dispatcher_, &broad_phase_, &solver_, &configuration_) {
        gCalculateCombinedRestitutionCallback = greaterRestitution;
        world_.setGravity(vectorOf(settings.gravity));
        for (size_t b = 0; b < contents.bodies.size(); ++b)
            add(b);
    }
    ~BulletMover() override {
        for (const auto& body : bodies_)
            world_.removeRigidBody(body.get());
    }
    BulletMover(const BulletMover&) = delete;
    BulletMover& operator=(const BulletMover&) = delete;

    Result<void> step(uint32_t steps) override {
        for (uint32_t k = 0; k < steps; ++k)
            world_.stepSimulation(static_cast<btScalar>(settings_.dt), 0);
        return {};
    }

    Result<std::vector<gpu::BodyState>> bodies() override {
        std::vector<gpu::BodyState> states = contents_.bodies;
        for (size_t b = 0; b < states.size(); ++b)
            if (states[b].offset.w != 0) readInto(states[b], b);
        return states;
    }

    double substep() const override { return settings_.dt; }

private:
    btRigidBody::btRigidBodyConstructionInfo infoOf(size_t b) {
        const gpu::BodyState& state = contents_.bodies[b];
        const gpu::BodyShape& shape = contents_.shapes[b];
        const bool moves = state.offset.w != 0;
        const brittle::Pose pose = brittle::poseOf(state);
        btRigidBody::btRigidBodyConstructionInfo info(moves ? 1 / state.offset.w : 0, nullptr, shapes_.shapeOf(b),
                                                      moves ? vectorOf(principalMoments(shape)) : btVector3(0, 0, 0));
        info.m_startWorldTransform = transformOf(pose.place, pose.turn) * transformOf(shapes_.middleOf(b), {0, 0, 0, 1});
        info.m_friction = settings_.friction ? std::sqrt(shape.inverse_inertia[0].w) : 0; // Bullet multiplies two
        info.m_restitution = settings_.restitution ? shape.inverse_inertia[1].w : 0;
        return info;
    }

    void add(size_t b) {
        btRigidBody& body = *bodies_.emplace_back(std::make_unique<btRigidBody>(infoOf(b)));
        body.setLinearVelocity(vectorOf(xyz(contents_.bodies[b].velocity)));
        body.setAngularVelocity(vectorOf(xyz(contents_.bodies[b].spin)));
        body.setActivationState(DISABLE_DEACTIVATION);
        if (contents_.bodies[b].offset.w != 0) {
            const auto half = static_cast<btScalar>(shapes_.halfExtent(b));
            body.setCcdMotionThreshold(half);
            body.setCcdSweptSphereRadius(half);
        }
        world_.addRigidBody(&body);
    }

    void readInto(gpu::BodyState& state, size_t b) const {
        const btRigidBody& body = *bodies_[b];
        const Point place = pointOf(body.getWorldTransform().getOrigin()), spin = pointOf(body.getAngularVelocity());
        const btQuaternion turn = body.getWorldTransform().getRotation();
        state.turn = {turn.x(), turn.y(), turn.z(), turn.w()};
        state.velocity = packed(pointOf(body.getLinearVelocity()), 0);
        state.spin = packed(spin, 0);
        state.momentum = packed(angularMomentumOf(b, spin, {turn.x(), turn.y(), turn.z(), turn.w()}), 0);
        support::moveTo(state, place);
    }

    Point angularMomentumOf(size_t b, const Point& spin, const brittle::Turn& turn) const {
        const Point moments = principalMoments(contents_.shapes[b]);
        Point own = brittle::turnedBack(turn, spin);
        for (size_t k = 0; k < 3; ++k)
            own[k] *= moments[k];
        return brittle::turnedBy(turn, own);
    }

    brittle::StepSettings settings_;
    const brittle::WorldContents& contents_;
    BulletShapes shapes_;
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broad_phase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld world_;
    std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

bool hasMoreThanMotion(const brittle::StepSettings& s) {
    return !s.contacts || s.sleeping || s.drag || s.impact_fracture || s.dust || s.debris_lifetime || s.events;
}

} // namespace

bool hasBullet() { return true; }

Result<std::unique_ptr<support::Mover>> makeBulletMover(const brittle::SceneDescription& scene,
                                                        const brittle::WorldContents& contents) {
    const auto settings = brittle::settingsOf(scene);
    if (!settings) return settings.error();
    if (hasMoreThanMotion(*settings))
        return Error{ErrorCode::Feature, "its effects are not those of Bullet: gravity, contacts, friction, restitution, ccd"};
    return std::unique_ptr<support::Mover>(std::make_unique<BulletMover>(*settings, contents));
}

} // namespace bench

#else

namespace bench {

bool hasBullet() { return false; }

engine::Result<std::unique_ptr<support::Mover>> makeBulletMover(const brittle::SceneDescription&,
                                                                const brittle::WorldContents&) {
    return engine::Error{engine::ErrorCode::Feature, "this build has no Bullet"};
}

} // namespace bench

#endif
