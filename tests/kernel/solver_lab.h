// What the tests of the solver's kernels share: bodies and contacts, and the device's numbers in double precision. Vectors and
// turns are Eigen's, which no kernel knows.
#pragma once

#include "shaders-spirv/shared/body.h"
#include "shaders-spirv/shared/solver.h"
#include "tests/kernel/lab.h"

#include <Eigen/Dense>

#include <random>

namespace kernel_test {

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;
using Quaternion = Eigen::Quaterniond;

class Chance {
public:
    explicit Chance(uint32_t seed) : random_(seed) {}
    double between(double low, double high) { return low + (high - low) * (static_cast<double>(random_()) / 4294967296.0); }
    uint32_t below(uint32_t end) { return static_cast<uint32_t>(random_() % end); }
    bool oneIn(uint32_t n) { return below(n) == 0; }
    Vector inBox(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
    Vector direction();
    Quaternion turn();
    std::mt19937& engine() { return random_; }

private:
    std::mt19937 random_;
};

inline Vector xyz(const gpu::vec4& v) { return {v.x, v.y, v.z}; }
gpu::vec4 wordsOf(const Vector& v, double w = 0);
gpu::vec4 wordsOf(const Quaternion& q);
Quaternion turnOf(const gpu::vec4& q);
inline Quaternion turnBy(double angle, const Vector& axis) { return Quaternion(Eigen::AngleAxisd(angle, axis.normalized())); }

struct RigidBody {
    gpu::BodyState state = {};
    gpu::BodyShape shape = {};
    bool moves() const { return state.offset.w != 0; }
    // Own axes to the world's; of one that does not move it is 0.
    Matrix inverseInertia() const;
    Vector place() const;
};
// Near the origin, with three moments of inertia, turned and moving; `moves` says whether it can.
RigidBody randomBody(Chance& chance, bool moves);
std::vector<RigidBody> randomBodies(Chance& chance, uint32_t count); // that move
// As begin_step is to make it.
gpu::SolverBody solverBodyOf(const RigidBody& body);

std::vector<gpu::BodyState> statesOf(const std::vector<RigidBody>& bodies);
std::vector<gpu::BodyShape> shapesOf(const std::vector<RigidBody>& bodies);
std::vector<gpu::SolverBody> solverBodiesOf(const std::vector<RigidBody>& bodies);

// Who touches whom: all that putting contacts in order goes by.
struct Touching {
    std::vector<bool> moves;      // of each body
    std::vector<Word2> bodies;    // of each contact, in the order of the list
    std::vector<uint32_t> colors; // that it had; NO_INDEX: none
    uint32_t count() const { return static_cast<uint32_t>(bodies.size()); }
    void add(uint32_t a, uint32_t b, uint32_t color = NO_INDEX);
};
// As close as in a heap: each body touches some of the next few.
Touching randomHeap(uint32_t contacts, uint32_t seed);

// The same on the device. What touches are some of the pairs that are remembered, not all.
struct DeviceTouching {
    explicit DeviceTouching(const Touching& touching);
    Counts counts;
    std::vector<uint32_t> pair_of; // where each contact is remembered
    engine::Buffer contact_pairs, memory, solver_bodies;
};

} // namespace kernel_test
