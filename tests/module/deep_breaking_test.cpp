// Fragments of fragments of fragments in a world that goes on: at every depth they are closed, and together what broke was.
#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/dynamics/scene_settings.h"
#include "tests/module/breaking_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>

namespace {

using namespace breaking_scenes;
using brittle::BodyFragment, brittle::SurfaceMesh;
using brittle::Double3, brittle::operator-;

constexpr uint32_t kDepth = 8, kSteps = 900;
constexpr double kRoom = 2; // m, between walls

// A block of concrete that flies about between six walls; it bounces, and what comes of it.
brittle::SceneDescription blockInARoom() {
    brittle::BodyDescription block;
    block.shape.size = {0.8, 0.8, 0.8};
    block.material = "concrete";
    block.velocity = {31, 17, 23};
    block.surface.restitution = 0.9;
    block.surface.friction = 0;
    brittle::SceneDescription scene = sceneOf({block}, false);
    scene.effects = {"contacts", "restitution", "impact_fracture", "refracture", "events"};
    scene.breaking.smallest_piece = 0;
    for (uint32_t side = 0; side < 6; ++side) {
        brittle::ColliderDescription wall;
        wall.shape.kind = brittle::ShapeKind::Box;
        wall.shape.size = {4, 4, 4};
        wall.place[side / 2] = (side % 2 == 0 ? -1 : 1) * (kRoom / 2 + 2);
        wall.surface.restitution = 0.9;
        scene.colliders.push_back(wall);
    }
    scene.budgets.most_fragments = 3;
    return scene;
}

Double3 placeOf(const brittle::FragmentVertex& vertex) { return brittle::positionOf(vertex); }

double volumeOf(const SurfaceMesh& surface) {
    double volume = 0;
    for (size_t t = 0; t + 2 < surface.indices.size(); t += 3) {
        const auto corner = [&](size_t k) { return placeOf(surface.vertices[surface.indices[t + k]]); };
        volume += brittle::dot(corner(0), brittle::cross(corner(1), corner(2))) / 6;
    }
    return volume;
}

// Edges by the places of their ends that are not walked as often one way as the other.
size_t openEdges(const SurfaceMesh& surface) {
    using Place = std::array<float, 3>;
    std::map<std::pair<Place, Place>, int> walked;
    const auto place = [&](size_t k) -> Place {
        const auto& p = surface.vertices[surface.indices[k]].position;
        return {p[0], p[1], p[2]};
    };
    for (size_t t = 0; t + 2 < surface.indices.size(); t += 3)
        for (size_t k = 0; k < 3; ++k) {
            const Place a = place(t + k), b = place(t + (k + 1) % 3);
            if (a != b) walked[std::minmax(a, b)] += a < b ? 1 : -1; // which rounding may have joined
        }
    return static_cast<size_t>(std::ranges::count_if(walked, [](const auto& edge) { return edge.second != 0; }));
}

// By slots, as of the last step: what every body of the world is the volume of, and whether it was there.
struct Known {
    std::map<uint32_t, double> volumes;
    std::map<uint32_t, uint32_t> generations;
};

struct Tally {
    std::array<uint32_t, kDepth + 1> fragments = {}, breaks = {}; // by generation
};

// Of those that came to be in this step.
void addFresh(brittle::World& world, const std::vector<BodyFragment>& fragments, uint32_t step, Known& known, Tally& tally) {
    std::vector<BodyFragment> fresh;
    std::ranges::copy_if(fragments, std::back_inserter(fresh), [&](const BodyFragment& f) { return f.step == step; });
    if (fresh.empty()) return;
    const auto surfaces = world.surfacesOf(fresh);
    ASSERT_TRUE(surfaces);
    std::map<uint32_t, double> sums;
    for (size_t k = 0; k < fresh.size(); ++k) {
        const double volume = volumeOf((*surfaces)[k]);
        EXPECT_EQ(openEdges((*surfaces)[k]), 0u) << "generation " << fresh[k].generation;
        EXPECT_GT(volume, 0);
        EXPECT_NEAR(double{fresh[k].record.form.x}, volume, 1e-5 * volume);
        EXPECT_EQ(fresh[k].generation, known.generations[fresh[k].parent] + 1);
        sums[fresh[k].parent] += volume;
        if (fresh[k].generation <= kDepth) ++tally.fragments[fresh[k].generation];
    }
    for (const auto& [parent, sum] : sums) {
        EXPECT_NEAR(sum, known.volumes[parent], 2e-6 * known.volumes[parent]) << "of generation " << known.generations[parent];
        if (known.generations[parent] <= kDepth) ++tally.breaks[known.generations[parent]];
    }
    for (size_t k = 0; k < fresh.size(); ++k) {
        known.volumes[fresh[k].slot] = volumeOf((*surfaces)[k]);
        known.generations[fresh[k].slot] = fresh[k].generation;
    }
}

TEST(DeepBreaking, GoesEightGenerationsDownAndKeepsTheContractInEach) {
    const brittle::SceneDescription scene = blockInARoom();
    const auto world = worldOf(scene, brittle::budgetOf(scene));
    const double mass = massOf(presentBodies(*world));
    Known known = {{{0, 0.8 * 0.8 * 0.8}}, {{0, 0}}};
    Tally tally;
    for (uint32_t k = 1; k <= kSteps && tally.fragments[kDepth] == 0; ++k) {
        step(*world);
        const auto fragments = world->fragments();
        ASSERT_TRUE(fragments);
        addFresh(*world, *fragments, k, known, tally);
        if (HasFatalFailure()) return;
    }
    for (uint32_t depth = 1; depth <= kDepth; ++depth)
        EXPECT_GT(tally.fragments[depth], 1u) << "fragments of generation " << depth;
    EXPECT_NEAR(massOf(presentBodies(*world)), mass, kDepth * 1e-6 * mass);
}

} // namespace
