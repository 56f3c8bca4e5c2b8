// Tests that the list of surfaces can be taken in parts. A device binds 128 MiB at once or a little more, and worlds of fine
// meshes need more. Small parts stand in for that here.
#include "modules/brittle/breaking/surface_list.h"
#include "modules/brittle/breaking/surface_places.h"
#include "modules/brittle/drawing/drawing.h"
#include "modules/brittle/dynamics/scene_contents.h"
#include "modules/brittle/dynamics/scene_settings.h"
#include "tests/engine/read_view.h"
#include "tests/engine/test_device.h"
#include "tests/module/breaking_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>

namespace {

using namespace breaking_scenes;
using brittle::BodyDescription, brittle::FreeRange, brittle::SceneDescription, brittle::SurfacePlaces, brittle::WorldContents;
using engine_test::valuesOf;

// Bodies whose surfaces have `triangles` triangles, one behind the other. Each vertex knows its triangle.
WorldContents contentsWith(const std::vector<uint32_t>& triangles) {
    WorldContents contents;
    for (const uint32_t count : triangles) {
        const auto first = static_cast<uint32_t>(contents.surface_vertices.size());
        gpu::BreakableBody body{};
        body.surface = {first, 3 * count, 0, 0};
        contents.breakable.push_back(body);
        for (uint32_t k = 0; k < 3 * count; ++k)
            contents.surface_vertices.push_back({{static_cast<float>(first + k), 0, 0}, {0, 0, 1}, {0, 0}});
    }
    return contents;
}

bool isInOnePart(const FreeRange& range, uint32_t part) { return range.begin / part == (range.begin + range.size - 1) / part; }

TEST(SurfacePlaces, StayWhereTheyAreIfOnePartHoldsThem) {
    const WorldContents contents = contentsWith({12, 40, 8});
    const SurfacePlaces places = brittle::placeSurfaces(contents, 39, 100);
    EXPECT_EQ(places.part_triangles, 104u) << "a multiple of eight";
    EXPECT_EQ(places.parts(), 1u);
    EXPECT_EQ(places.capacity, 99u);
    EXPECT_EQ(places.free, (std::vector<FreeRange>{{60, 39}}));
    for (const auto& [first, moved] : places.moved)
        EXPECT_EQ(first, moved);
}

// Every triangle is a surface's, or free, or the last one of its part.
TEST(SurfacePlaces, LieInOnePartEachAndWhatIsFreeDoesToo) {
    std::mt19937 engine(7);
    const auto random = [&] { return static_cast<uint32_t>(engine()); };
    for (int round = 0; round < 50; ++round) {
        std::vector<uint32_t> triangles(1 + random() % 40);
        for (uint32_t& count : triangles)
            count = 1 + random() % 100;
        WorldContents contents = contentsWith(triangles);
        const WorldContents before = contents;
        const uint32_t room = random() % 2000;
        const SurfacePlaces places = brittle::placeSurfaces(contents, room, 64);
        std::vector<int> uses(places.capacity);
        uint64_t free = 0;
        for (const FreeRange& range : places.free) {
            EXPECT_TRUE(isInOnePart(range, places.part_triangles));
            free += range.size;
            for (uint32_t k = range.begin; k < range.begin + range.size; ++k)
                uses.at(k)++;
        }
        EXPECT_GE(free, room);
        brittle::moveSurfaces(contents, places);
        ASSERT_EQ(contents.surface_vertices.size(), 3 * size_t{places.capacity});
        for (size_t body = 0; body < triangles.size(); ++body) {
            const uint32_t first = contents.breakable[body].surface.x, was = before.breakable[body].surface.x;
            EXPECT_TRUE(isInOnePart({first / 3, triangles[body]}, places.part_triangles));
            for (uint32_t k = 0; k < 3 * triangles[body]; ++k)
                EXPECT_EQ(contents.surface_vertices[first + k].position[0], before.surface_vertices[was + k].position[0]);
            for (uint32_t k = 0; k < triangles[body]; ++k)
                uses.at(first / 3 + k)++;
        }
        for (uint32_t k = 0; k < places.capacity; ++k)
            EXPECT_EQ(uses[k], (k + 1) % places.part_triangles == 0 && k + 1 < places.capacity ? 0 : 1) << k;
    }
}

TEST(SurfacePlaces, PartsGrowWithTheLargestSurface) {
    EXPECT_EQ(brittle::placeSurfaces(contentsWith({5, 200}), 10, 64).part_triangles, 208u);
}

TEST(SurfaceList, PartsFollowEachOtherWithoutAGap) {
    const engine::Buffer buffer = *engine::Buffer::create(engine_test::device(), 96 * 150, engine::BufferDomain::Device);
    const brittle::SurfaceList list(engine::BufferView(buffer), 64);
    ASSERT_EQ(list.partCount(), 3u);
    uint32_t end = 0;
    for (const brittle::SurfacePart& part : list.parts()) {
        EXPECT_EQ(part.range.first, end);
        EXPECT_EQ(part.vertices.offset, 32 * end);
        end = part.range.end;
        EXPECT_EQ(part.vertices.offset + part.vertices.size, 32 * end);
    }
    EXPECT_EQ(end, 450u);
    EXPECT_EQ(brittle::SurfaceList(engine::BufferView(buffer)).partCount(), 1u);
}

// A pane that breaks in rays, boxes that break otherwise, and a ball that does not break. All break again when they land.
SceneDescription mixture() {
    BodyDescription pane, box = ball({0.9, 0.25, 0}, "concrete");
    pane.shape.size = {0.8, 0.004, 0.8};
    pane.place = {0, 0.4, 0};
    pane.material = "glass";
    pane.break_pattern = brittle::BreakPattern::Radial;
    box.velocity = {0, -9, 0};
    BodyDescription thrown = ball({0.1, 0.65, 0.05}, "");
    thrown.mass = 0.5;
    thrown.velocity = {0, -20, 0};
    BodyDescription far = ball({3, 1, 0}, "glass");
    SceneDescription scene = sceneOf({pane, box, thrown, far});
    scene.effects.emplace_back("refracture");
    return scene;
}

std::unique_ptr<brittle::World> inPartsOf(uint32_t triangles) {
    const SceneDescription scene = mixture();
    brittle::WorldSurfaces surfaces;
    auto contents = brittle::contentsOf(scene, {}, nullptr, &surfaces);
    EXPECT_TRUE(contents);
    brittle::addLooks(*contents, surfaces);
    brittle::WorldBudget budget;
    budget.breaking.triangles = 40'000;
    budget.breaking.part_triangles = triangles;
    auto world = brittle::World::create(engine_test::device(), *contents, *brittle::settingsOf(scene), budget);
    EXPECT_TRUE(world) << world.error().message;
    return std::move(*world);
}

void expectSameBytes(const auto& a, const auto& b, const std::string& what) {
    ASSERT_EQ(a.size(), b.size()) << what;
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]), 0) << what;
}

void expectSameFragments(brittle::World& a, brittle::World& b, const std::string& when) {
    const auto of_a = a.fragments(), of_b = b.fragments();
    ASSERT_TRUE(of_a && of_b);
    ASSERT_EQ(of_a->size(), of_b->size()) << when;
    const auto surfaces_a = a.surfacesOf(*of_a), surfaces_b = b.surfacesOf(*of_b);
    for (size_t k = 0; k < of_a->size(); ++k) {
        EXPECT_EQ((*of_a)[k].slot, (*of_b)[k].slot) << when;
        expectSameBytes((*surfaces_a)[k].vertices, (*surfaces_b)[k].vertices, when);
    }
}

// The vertices that a draw of a body shows, in their own frame.
std::vector<gpu::SceneVertex> drawnOf(brittle::World& world, uint32_t body) {
    EXPECT_TRUE(world.updateDraws({0, 0, 0}));
    const auto buffers = world.drawBuffers();
    const auto commands = valuesOf<gpu::DrawCommand>(buffers->commands);
    const auto bodies = valuesOf<gpu::DrawnBody>(buffers->bodies);
    const auto vertices = valuesOf<gpu::SceneVertex>(buffers->vertices);
    std::vector<gpu::SceneVertex> drawn;
    for (const gpu::DrawCommand& c : commands)
        if (c.instance_count > 0 && bodies[c.first_instance / 2].body == body)
            drawn.insert(drawn.end(), vertices.begin() + c.first_index, vertices.begin() + c.first_index + c.index_count);
    return drawn;
}

TEST(SurfaceParts, ChangeNoBitOfHowThingsBreakAndMove) {
    const auto whole = inPartsOf(0), parts = inPartsOf(1000);
    EXPECT_GT(parts->dispatches(), whole->dispatches() + 30) << "many parts";
    uint32_t broken = 0;
    for (uint32_t k = 0; k < 20; ++k) {
        const std::string when = "step " + std::to_string(k);
        if (k == 5) {
            for (brittle::World* world : {whole.get(), parts.get()})
                ASSERT_TRUE(world->strike({{3, 1, 0.1}, 0.05, 500}));
        }
        step(*whole);
        step(*parts);
        broken += static_cast<uint32_t>(whole->breaks()->events.size());
        expectSameBytes(*whole->bodies(), *parts->bodies(), when);
        if (k % 9 == 4) expectSameFragments(*whole, *parts, when);
    }
    EXPECT_GE(broken, 5u) << "all three, and fragments of them";
    expectSameFragments(*whole, *parts, "in the end");
    const auto drawn = drawnOf(*parts, 2);
    EXPECT_GE(drawn.size(), 60u) << "the ball";
    expectSameBytes(drawnOf(*whole, 2), drawn, "drawn vertices");
}

} // namespace
