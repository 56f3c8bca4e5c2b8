#include "tests/kernel/solver_lab.h"

#include <algorithm>

namespace kernel_test {

Vector Chance::direction() {
    for (;;) {
        const Vector v = inBox(1);
        if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
    }
}

Quaternion Chance::turn() {
    for (;;) {
        Eigen::Vector4d v;
        for (const int k : {3, 2, 1, 0})
            v[k] = between(-1, 1);
        if (v.norm() > 0.1 && v.norm() < 1) return Quaternion(v.normalized());
    }
}

gpu::vec4 wordsOf(const Vector& v, double w) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()), static_cast<float>(w)};
}

gpu::vec4 wordsOf(const Quaternion& q) { return wordsOf(q.vec(), q.w()); }

Quaternion turnOf(const gpu::vec4& q) { return Quaternion(double{q.w}, double{q.x}, double{q.y}, double{q.z}).normalized(); }

Matrix RigidBody::inverseInertia() const {
    Matrix own;
    for (int row = 0; row < 3; ++row)
        own.row(row) = xyz(shape.inverse_inertia[row]);
    const Matrix axes = turnOf(state.turn).toRotationMatrix();
    return axes * own * axes.transpose();
}

Vector RigidBody::place() const {
    return SECTOR_EDGE * Vector(state.sector.x, state.sector.y, state.sector.z) + xyz(state.offset);
}

RigidBody randomBody(Chance& chance, bool moves) {
    RigidBody body;
    const double inverse_mass = moves ? 1 / chance.between(0.5, 40) : 0;
    body.state.offset = wordsOf(chance.inBox(3), inverse_mass);
    body.state.turn = wordsOf(chance.turn());
    body.shape.inverse_inertia[0].w = static_cast<float>(chance.between(0.1, 1.5));
    body.shape.inverse_inertia[1].w = static_cast<float>(chance.between(0, 1));
    body.shape.inverse_inertia[2].w = static_cast<float>(chance.between(0.2, 2));
    if (!moves) return body;
    body.state.velocity = wordsOf(chance.inBox(4));
    body.state.spin = wordsOf(chance.inBox(4));
    // Of a box of these edges, so that it is the inertia of a solid.
    const double mass = 1.0 / body.state.offset.w, x = chance.between(0.2, 1), y = chance.between(0.2, 1),
                 z = chance.between(0.2, 1);
    body.shape.inverse_inertia[0].x = static_cast<float>(12 / (mass * (y * y + z * z)));
    body.shape.inverse_inertia[1].y = static_cast<float>(12 / (mass * (x * x + z * z)));
    body.shape.inverse_inertia[2].z = static_cast<float>(12 / (mass * (x * x + y * y)));
    body.state.momentum = wordsOf(body.inverseInertia().inverse() * xyz(body.state.spin));
    return body;
}

std::vector<RigidBody> randomBodies(Chance& chance, uint32_t count) {
    std::vector<RigidBody> bodies;
    for (uint32_t k = 0; k < count; ++k)
        bodies.push_back(randomBody(chance, true));
    return bodies;
}

gpu::SolverBody solverBodyOf(const RigidBody& body) {
    const Matrix m = body.inverseInertia();
    return {wordsOf(xyz(body.state.velocity), body.state.offset.w),
            wordsOf(xyz(body.state.spin), m(2, 2)),
            wordsOf(Vector(m(0, 0), m(0, 1), m(0, 2)), m(1, 1)),
            wordsOf(Vector(0, 0, 0), m(1, 2)),
            {0, 0, 0, 1}};
}

std::vector<gpu::BodyState> statesOf(const std::vector<RigidBody>& bodies) {
    std::vector<gpu::BodyState> states;
    for (const RigidBody& body : bodies)
        states.push_back(body.state);
    return states;
}

std::vector<gpu::BodyShape> shapesOf(const std::vector<RigidBody>& bodies) {
    std::vector<gpu::BodyShape> shapes;
    for (const RigidBody& body : bodies)
        shapes.push_back(body.shape);
    return shapes;
}

std::vector<gpu::SolverBody> solverBodiesOf(const std::vector<RigidBody>& bodies) {
    std::vector<gpu::SolverBody> solver_bodies;
    for (const RigidBody& body : bodies)
        solver_bodies.push_back(solverBodyOf(body));
    return solver_bodies;
}

void Touching::add(uint32_t a, uint32_t b, uint32_t color) {
    bodies.push_back({a, b});
    colors.push_back(color);
}

Touching randomHeap(uint32_t contacts, uint32_t seed) {
    Chance chance(seed);
    Touching heap;
    const uint32_t bodies = contacts / 4 + 2;
    for (uint32_t b = 0; b < bodies; ++b)
        heap.moves.push_back(!chance.oneIn(10));
    while (heap.count() < contacts) {
        const uint32_t a = chance.below(bodies), b = (a + 1 + chance.below(std::min(bodies - 1, 12u))) % bodies;
        if (a != b && (heap.moves[a] || heap.moves[b] || contacts < 4)) heap.add(std::min(a, b), std::max(a, b));
    }
    return heap;
}

DeviceTouching::DeviceTouching(const Touching& touching) {
    std::vector<gpu::ContactMemory> pairs(3 * touching.bodies.size() + 1);
    for (uint32_t c = 0; c < touching.count(); ++c) {
        pair_of.push_back(3 * c + c % 2);
        pairs[pair_of[c]].ids = {touching.bodies[c][0], touching.bodies[c][1], 1, touching.colors[c]};
    }
    std::vector<gpu::SolverBody> bodies(touching.moves.size());
    for (size_t b = 0; b < bodies.size(); ++b)
        bodies[b].velocity.w = touching.moves[b] ? 1.0f : 0.0f;
    counts[COUNT_CONTACTS] = touching.count();
    contact_pairs = bufferOf(pair_of);
    memory = bufferOf(pairs);
    solver_bodies = bufferOf(bodies);
}

} // namespace kernel_test
