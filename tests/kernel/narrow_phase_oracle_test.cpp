// The narrow phase against brute force in double precision: overlap by the separating axis theorem over all faces and all pairs
// of edges, impacts by the intervals on the same axes.
#include "tests/kernel/random_pairs.h"
#include "tests/reference/sweep.h"

#include <algorithm>
#include <cmath>

namespace kernel_test {
namespace {

using reference::length;
using reference::operator+;
using reference::operator-;
using reference::operator*;

struct Tally {
    uint32_t overlapping = 0, apart = 0, empty = 0, ghosts = 0;
    double worst_depth = 0, worst_normal = 0; // the first as a share of the larger radius
    uint32_t worst_pair = 0;
};

double marginOf(double smaller) { return std::min(.02, .1 * smaller); }

void compare(Tally& tally, const HullScene& scene, uint32_t k, const gpu::Manifold& m) {
    const auto [a, b] = scene.pairs[k];
    const double overlap = reference::overlapOf(scene.solidOf(a, a), scene.solidOf(b, a));
    const double size_a = radiusOf(scene.shapes[scene.bodies[a].shape]), size_b = radiusOf(scene.shapes[scene.bodies[b].shape]);
    const double larger = std::max(size_a, size_b), doubt = 1e-4 * larger;
    if (m.info.x > 0)
        tally.worst_normal = std::max(tally.worst_normal, std::abs(length({m.normal.x, m.normal.y, m.normal.z}) - 1));
    if (overlap < -marginOf(std::min(size_a, size_b)) - doubt) {
        ++tally.apart;
        tally.ghosts += m.info.x > 0;
    }
    if (overlap <= doubt) return;
    ++tally.overlapping;
    tally.empty += m.info.x == 0;
    double deepest = 1e300;
    for (uint32_t p = 0; p < m.info.x; ++p)
        deepest = std::min(deepest, static_cast<double>(m.points[p].arm_a.w));
    const double error = std::abs(-deepest - overlap) / larger;
    if (error <= tally.worst_depth) return;
    tally.worst_depth = error;
    tally.worst_pair = k;
}

void expectAgreement(uint32_t count, uint32_t seed) {
    std::mt19937 random(seed);
    HullScene scene;
    addForms(scene, random, 80);
    addRandomPairs(scene, random, 80, count);
    const auto manifolds = manifoldsOf(scene, {.options = {.duration = 0}});
    Tally tally;
    for (uint32_t k = 0; k < count; ++k)
        compare(tally, scene, k, manifolds[k]);
    EXPECT_EQ(tally.empty, 0u);
    EXPECT_EQ(tally.ghosts, 0u);
    EXPECT_LT(tally.worst_depth, 1e-4) << "pair " << tally.worst_pair;
    EXPECT_LT(tally.worst_normal, 1e-5);
    EXPECT_GT(tally.overlapping, count / 3);
    EXPECT_GT(tally.apart, count / 20);
    std::printf("%u overlapping, %u apart, depth off by %.2g, normal by %.2g\n", tally.overlapping, tally.apart,
                tally.worst_depth, tally.worst_normal);
}

TEST(NarrowPhaseOracle, OverlapsAsDeepAsBruteForceSays) { expectAgreement(1500, 1); }

TEST(LongHardScenes, hard_27_sat_oracle) {
    for (uint32_t seed = 0; seed < 10; ++seed)
        expectAgreement(10000, 100 + seed);
}

} // namespace
} // namespace kernel_test
