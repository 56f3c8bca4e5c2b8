// Worlds of hosts: what is added to them, how they are stepped, what they tell.
#include "tests/abi/hosting.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>

namespace {

using namespace abi_test;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Bodies that fall and lie, and do not break: as cheap a world as there is.
BrittleWorldDef plainDef() {
    BrittleWorldDef def = brittleDefaultWorldDef();
    def.effects = BRITTLE_EFFECT_GRAVITY | BRITTLE_EFFECT_CONTACTS | BRITTLE_EFFECT_FRICTION;
    return def;
}

TEST(SmallAbiWorld, FallsAsFarAsGravitySays) {
    const Hosting host;
    BrittleBodyDef cube = brittleDefaultBodyDef();
    cube.position = {3, 100, -2};
    cube.velocity = {1, 0, 0};
    const Scene scene = makeScene(host, {cube}, plainDef());
    MUST(host, brittleStep(host, scene.world, 60));
    BrittleBodyState state;
    MUST(host, brittleGetBody(host, scene.world, scene.bodies[0], &state));
    EXPECT_NEAR(state.position.y, 100 - 0.5 * 9.81, 1e-3);
    EXPECT_NEAR(state.position.x, 4, 1e-4);
    EXPECT_NEAR(state.velocity.y, -9.81 * (1 - 0.5 / 240), 1e-3) << "half a substep behind";
    EXPECT_NEAR(state.mass, 1000, 1e-2);
    EXPECT_EQ(state.body.id, scene.bodies[0].id);
    EXPECT_EQ(state.origin.id, scene.bodies[0].id);
    EXPECT_EQ(state.is_fragment + state.is_collider + state.is_asleep, 0u);
}

// The frame that a shape was given in stays with the body, whatever its principal axes are.
TEST(AbiWorld, SaysWhereTheFrameOfAShapeIs) {
    const Hosting host;
    const BrittleVec3 corners[] = {{1, 0, 0}, {4, 0.5, 0}, {1, 2, 0}, {1, 0, 1}, {3, 1, 2}};
    BrittleBodyDef hull = brittleDefaultBodyDef();
    hull.shape.kind = BRITTLE_SHAPE_HULL;
    hull.shape.points = corners;
    hull.shape.point_count = 5;
    hull.position = {1, 2, 3};
    hull.rotation = {0.5, 0.5, 0.5, 0.5};
    BrittleWorldDef def = plainDef();
    def.effects = BRITTLE_EFFECT_CONTACTS;
    const Scene scene = makeScene(host, {hull}, def);
    BrittleBodyState state;
    MUST(host, brittleGetBody(host, scene.world, scene.bodies[0], &state));
    EXPECT_NEAR(state.shape_position.x, 1, 1e-5);
    EXPECT_NEAR(state.shape_position.y, 2, 1e-5);
    EXPECT_NEAR(state.shape_position.z, 3, 1e-5);
    const double cosine =
        0.5 * (state.shape_rotation.x + state.shape_rotation.y + state.shape_rotation.z + state.shape_rotation.w);
    EXPECT_NEAR(std::abs(cosine), 1, 1e-6);
}

TEST(SmallAbiWorld, RefusesWhatIsNoDefinition) {
    const Hosting host;
    BrittleWorld world = {0};
    const auto made = [&](auto&& change) {
        BrittleWorldDef def = plainDef();
        change(def);
        return brittleCreateWorld(host, &def, &world);
    };
    EXPECT_EQ(made([](BrittleWorldDef& d) { d.struct_size += 4; }), BRITTLE_WRONG_VERSION);
    EXPECT_EQ(made([](BrittleWorldDef& d) { d.gravity.x = kNan; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(made([](BrittleWorldDef& d) { d.dt = 0; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(made([](BrittleWorldDef& d) { d.dt = -kNan; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(made([](BrittleWorldDef& d) { d.substeps = 0; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(made([](BrittleWorldDef& d) { d.iterations = 65; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(made([](BrittleWorldDef& d) { d.effects = 1u << 30; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(made([](BrittleWorldDef& d) { d.smallest_piece = -1; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(world.id, 0u);
    EXPECT_EQ(brittleCreateWorld(host, nullptr, &world), BRITTLE_NULL_ARGUMENT);
    ASSERT_EQ(made([](BrittleWorldDef&) {}), BRITTLE_OK) << host.error();

    BrittleBody body = {0};
    const auto added = [&](auto&& change) {
        BrittleBodyDef def = brittleDefaultBodyDef();
        change(def);
        return brittleAddBody(host, world, &def, &body);
    };
    EXPECT_EQ(added([](BrittleBodyDef& d) { d.struct_size = 0; }), BRITTLE_WRONG_VERSION);
    EXPECT_EQ(added([](BrittleBodyDef& d) { d.position.z = kNan; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(added([](BrittleBodyDef& d) { d.position.z = 1e9; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(added([](BrittleBodyDef& d) { d.rotation = {0, 0, 0, 0}; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(added([](BrittleBodyDef& d) { d.shape.size.x = 0; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(added([](BrittleBodyDef& d) { d.shape.kind = 9; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(added([](BrittleBodyDef& d) { d.shape.kind = BRITTLE_SHAPE_PLANE; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(added([](BrittleBodyDef& d) { d.shape.kind = BRITTLE_SHAPE_MESH; }), BRITTLE_WRONG_HANDLE);
    EXPECT_EQ(added([](BrittleBodyDef& d) { d.shape.kind = BRITTLE_SHAPE_HULL; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(added([](BrittleBodyDef& d) { d.shape.kind = BRITTLE_SHAPE_HULL, d.shape.point_count = 5; }),
              BRITTLE_NULL_ARGUMENT);
    EXPECT_EQ(added([](BrittleBodyDef& d) { d.mass = -1; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(added([](BrittleBodyDef& d) { d.mass = d.density = 5; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(added([](BrittleBodyDef& d) { d.friction = kNan; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(added([](BrittleBodyDef& d) { d.pattern = 3; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(added([](BrittleBodyDef& d) { d.material = {12345}; }), BRITTLE_WRONG_HANDLE);
    EXPECT_EQ(added([](BrittleBodyDef& d) { d.is_fixed = 1, d.velocity.x = 1; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(body.id, 0u);
    const BrittleColliderDef plane = brittleDefaultColliderDef();
    BrittleColliderDef collider = plane;
    collider.friction = -1;
    EXPECT_EQ(brittleAddCollider(host, world, &collider, &body), BRITTLE_BAD_VALUE);
    collider = plane;
    collider.rotation = {kNan, 0, 0, 1};
    EXPECT_EQ(brittleAddCollider(host, world, &collider, &body), BRITTLE_BAD_VALUE);
    EXPECT_EQ(brittleStartWorld(host, world), BRITTLE_BAD_VALUE) << "nothing is in it";
}

// Scenes call some fields otherwise, and say of turns and hulls what only files can.
TEST(SmallAbiWorld, SaysWhichFieldIsWrongByItsName) {
    const Hosting host;
    BrittleWorld world = {0};
    BrittleBody body = {0};
    const auto of_world = [&](double BrittleWorldDef::*field) {
        BrittleWorldDef def = plainDef();
        def.*field = -1;
        EXPECT_EQ(brittleCreateWorld(host, &def, &world), BRITTLE_BAD_VALUE);
        return std::string(host.error());
    };
    const auto of_body = [&](auto&& change) {
        BrittleBodyDef def = brittleDefaultBodyDef();
        change(def);
        EXPECT_EQ(brittleAddBody(host, world, &def, &body), BRITTLE_BAD_VALUE);
        return std::string(host.error());
    };
    EXPECT_TRUE(of_world(&BrittleWorldDef::dust_lifetime).starts_with("'dust_lifetime' is -1"));
    EXPECT_TRUE(of_world(&BrittleWorldDef::debris_below).starts_with("'debris_below' is -1"));
    EXPECT_TRUE(of_world(&BrittleWorldDef::debris_after).starts_with("'debris_after' is -1"));
    EXPECT_TRUE(of_world(&BrittleWorldDef::debris_fade).starts_with("'debris_fade' is -1"));
    BrittleWorldDef def = plainDef();
    MUST(host, brittleCreateWorld(host, &def, &world));
    EXPECT_NE(of_body([](BrittleBodyDef& d) { d.position.x = kNan; }).find("'position' holds nan"), std::string::npos);
    const std::string turn = of_body([](BrittleBodyDef& d) { d.rotation = {0, 0, 0, 0}; });
    EXPECT_NE(turn.find("'rotation'"), std::string::npos) << turn;
    EXPECT_EQ(turn.find("axis"), std::string::npos) << turn;
    for (const double part : {1e-200, 1e-7, 1e7, 1e200}) {
        const std::string fault = of_body([&](BrittleBodyDef& d) { d.rotation = {part, part, part, part}; });
        EXPECT_NE(fault.find(part < 1 ? "have a length of 2e-" : "each from -1000 to 1000"), std::string::npos) << fault;
    }
    EXPECT_EQ(brittleStartWorld(host, world), BRITTLE_BAD_VALUE);
    EXPECT_NE(host.error().find("the world has no body; call brittleAddBody"), std::string::npos) << host.error();
    EXPECT_EQ(of_body([](BrittleBodyDef& d) { d.shape.kind = BRITTLE_SHAPE_HULL; }), "body 0: a hull needs 'points'");
    const std::string held = of_body([](BrittleBodyDef& d) { d.is_fixed = 1, d.spin.x = 1; });
    EXPECT_NE(held.find("has 'is_fixed' = 1 and a 'velocity' or a 'spin'"), std::string::npos) << held;
}

TEST(SmallAbiWorld, AnswersWhatComesInTheWrongOrder) {
    const Hosting host;
    const Scene scene = makeScene(host, {brittleDefaultBodyDef()}, plainDef(), false);
    uint32_t count = 0;
    uint64_t hash = 0;
    size_t size = 0;
    EXPECT_EQ(brittleStep(host, scene.world, 1), BRITTLE_WRONG_ORDER);
    EXPECT_EQ(brittleFinishSteps(host, scene.world), BRITTLE_WRONG_ORDER);
    EXPECT_EQ(brittleDamage(host, scene.world, {0, 0, 0}, 1, 1), BRITTLE_WRONG_ORDER);
    EXPECT_EQ(brittleGetBodies(host, scene.world, nullptr, 0, &count), BRITTLE_WRONG_ORDER);
    EXPECT_EQ(brittleHashState(host, scene.world, &hash), BRITTLE_WRONG_ORDER);
    EXPECT_EQ(brittleSaveState(host, scene.world, nullptr, 0, &size), BRITTLE_WRONG_ORDER);
    EXPECT_EQ(brittleUpdateDraws(host, scene.world, {0, 0, 0}), BRITTLE_WRONG_ORDER);
    MUST(host, brittleStartWorld(host, scene.world));
    EXPECT_EQ(brittleStartWorld(host, scene.world), BRITTLE_WRONG_ORDER);
    const BrittleBodyDef late = brittleDefaultBodyDef();
    BrittleBody body = {0};
    EXPECT_EQ(brittleAddBody(host, scene.world, &late, &body), BRITTLE_WRONG_ORDER);
    EXPECT_EQ(brittleStep(host, scene.world, 2'000'000), BRITTLE_BAD_VALUE);
    EXPECT_EQ(brittleDamage(host, scene.world, {0, 0, 0}, 1, 1), BRITTLE_BAD_VALUE) << "nothing here can break";
    EXPECT_EQ(brittleRecordSteps(host, scene.world, nullptr, 1), BRITTLE_NULL_ARGUMENT);
    const_cast<Hosting&>(host).device().submit([&](VkCommandBuffer commands) {
        EXPECT_EQ(brittleRecordDraws(host, scene.world, commands, {0, 0, 0}), BRITTLE_WRONG_ORDER) << "no buffers yet";
        EXPECT_EQ(brittleRecordSteps(host, scene.world, commands, 0), BRITTLE_BAD_VALUE);
        EXPECT_EQ(brittleRecordSteps(host, scene.world, commands, 2), BRITTLE_OK) << host.error();
    });
    EXPECT_EQ(brittleHashState(host, scene.world, &hash), BRITTLE_WRONG_ORDER) << "they have to be finished";
    EXPECT_EQ(brittleStep(host, scene.world, 1), BRITTLE_WRONG_ORDER);
    MUST(host, brittleFinishSteps(host, scene.world));
    MUST(host, brittleFinishSteps(host, scene.world));
    MUST(host, brittleHashState(host, scene.world, &hash));
    MUST(host, brittleDestroyWorld(host, scene.world));
    EXPECT_EQ(brittleStep(host, scene.world, 1), BRITTLE_STALE_HANDLE);
    EXPECT_EQ(brittleDestroyWorld(host, scene.world), BRITTLE_STALE_HANDLE);
}

TEST(SmallAbiWorld, AnswersNullsAndIdsOfOthers) {
    const Hosting host;
    const Scene scene = makeScene(host, {brittleDefaultBodyDef()}, plainDef()),
                other = makeScene(host, {brittleDefaultBodyDef()}, plainDef(), false);
    const BrittleWorld w = scene.world;
    BrittleBodyState state;
    BrittleCounts counts = {};
    BrittleDrawBuffers buffers = {};
    uint32_t number = 0, count = 0, outer = 0;
    EXPECT_EQ(brittleGetBodies(host, w, nullptr, 0, nullptr), BRITTLE_NULL_ARGUMENT);
    EXPECT_EQ(brittleGetBodies(host, w, nullptr, 5, &count), BRITTLE_NULL_ARGUMENT);
    EXPECT_EQ(brittleGetBodies(host, w, nullptr, 0, &count), BRITTLE_BUFFER_TOO_SMALL);
    EXPECT_EQ(count, 2u);
    EXPECT_EQ(brittleGetBodies(host, w, &state, 1, &count), BRITTLE_BUFFER_TOO_SMALL);
    EXPECT_EQ(state.body.id, scene.bodies[0].id) << "the first ones stand";
    EXPECT_EQ(brittleGetBody(host, w, scene.bodies[0], nullptr), BRITTLE_NULL_ARGUMENT);
    EXPECT_EQ(brittleGetBody(host, w, {0}, &state), BRITTLE_WRONG_HANDLE);
    EXPECT_EQ(brittleGetBody(host, w, other.bodies[0], &state), BRITTLE_WRONG_HANDLE) << "of another world";
    EXPECT_EQ(brittleGetBody(host, {scene.bodies[0].id}, scene.bodies[0], &state), BRITTLE_WRONG_HANDLE);
    EXPECT_EQ(brittleGetCounts(host, w, &counts), BRITTLE_WRONG_VERSION);
    EXPECT_EQ(brittleGetDrawBuffers(host, w, &buffers), BRITTLE_WRONG_VERSION);
    EXPECT_EQ(brittleNumberOf(host, w, {7}, &number), BRITTLE_WRONG_HANDLE);
    EXPECT_EQ(brittleHashState(host, w, nullptr), BRITTLE_NULL_ARGUMENT);
    EXPECT_EQ(brittleSaveState(host, w, nullptr, 0, nullptr), BRITTLE_NULL_ARGUMENT);
    EXPECT_EQ(brittleRestoreState(host, w, nullptr, 0), BRITTLE_NULL_ARGUMENT);
    EXPECT_EQ(brittleGetSurface(host, w, scene.bodies[0], nullptr, 0, &count, nullptr), BRITTLE_NULL_ARGUMENT);
    EXPECT_EQ(brittleGetBreaks(host, w, nullptr, 0, &count), BRITTLE_BAD_VALUE) << "it has not that effect";
    EXPECT_EQ(brittleStep(nullptr, w, 1), BRITTLE_NULL_ARGUMENT);
    EXPECT_EQ(brittleUpdateDraws(host, w, {kNan, 0, 0}), BRITTLE_BAD_VALUE);
    for (int bit = 0; bit < 64; ++bit) {
        const BrittleBody other_one = {scene.bodies[0].id ^ uint64_t{1} << bit};
        if (other_one.id != scene.ground.id) {
            EXPECT_NE(brittleGetBody(host, w, other_one, &state), BRITTLE_OK) << bit;
        }
    }
    MUST(host, brittleGetSurface(host, w, scene.bodies[0], nullptr, 0, &count, &outer) == BRITTLE_BUFFER_TOO_SMALL
                   ? BRITTLE_OK
                   : BRITTLE_INTERNAL);
    std::vector<BrittleVertex> surface(count);
    MUST(host, brittleGetSurface(host, w, scene.bodies[0], surface.data(), count, &count, &outer));
    EXPECT_EQ(count, 36u);
    EXPECT_EQ(outer, 36u);
    for (const BrittleVertex& v : surface)
        EXPECT_NEAR(std::abs(v.position[0]), 0.5, 1e-6);
}

// All of a break: fragments with the mass of the whole, an event that adds up, ids that go stale.
TEST(AbiWorld, BreaksWhatFallsHardEnoughAndTellsOfIt) {
    const Hosting host;
    const BrittleBodyDef cube = glassCube(host, 1.5);
    const Scene scene = makeScene(host, {cube});
    BrittleBodyState whole;
    MUST(host, brittleGetBody(host, scene.world, scene.bodies[0], &whole));
    MUST(host, brittleStep(host, scene.world, 40));
    const auto breaks = breaksOf(host, scene.world);
    ASSERT_EQ(breaks.size(), 1u);
    const BrittleBreak& b = breaks[0];
    EXPECT_EQ(b.body.id, scene.bodies[0].id);
    EXPECT_EQ(b.hit_by.id, scene.ground.id);
    EXPECT_EQ(b.outcome, uint32_t{BRITTLE_BROKE});
    EXPECT_GE(b.fragments, 2u);
    EXPECT_NEAR(b.position.y, 0, 0.02);
    EXPECT_NEAR(b.normal.y, -1, 1e-3);
    EXPECT_NEAR(b.speed, std::sqrt(2 * 9.81 * 1.35), 0.2);
    EXPECT_GT(b.crack_area, 0);
    EXPECT_NEAR(b.energy_before - b.energy_after, b.crack_energy, 1e-3 * b.energy_before);
    EXPECT_TRUE(breaksOf(host, scene.world).empty()) << "each is told once";
    EXPECT_EQ(b.origin.id, b.body.id);
    EXPECT_EQ(b.material.id, cube.material.id);
    EXPECT_GT(b.smallest_mass, 0);
    EXPECT_LE(b.smallest_mass, b.largest_mass);
    EXPECT_LT(b.largest_mass, whole.mass);

    const auto bodies = bodiesOf(host, scene.world);
    EXPECT_EQ(bodies.size(), b.fragments + 1u);
    double mass = b.dust_mass;
    std::set<uint64_t> ids;
    for (const BrittleBodyState& s : bodies) {
        mass += s.mass;
        ids.insert(s.body.id);
        if (s.is_collider) continue;
        EXPECT_EQ(s.is_fragment, 1u);
        EXPECT_EQ(s.origin.id, scene.bodies[0].id);
        EXPECT_EQ(s.made_in_step, b.step);
    }
    EXPECT_EQ(ids.size(), bodies.size());
    EXPECT_NEAR(mass, whole.mass, 1e-4 * whole.mass);
    BrittleBodyState state;
    EXPECT_EQ(brittleGetBody(host, scene.world, scene.bodies[0], &state), BRITTLE_STALE_HANDLE) << "it has broken";
    for (const BrittleBodyState& s : bodies)
        MUST(host, brittleGetBody(host, scene.world, s.body, &state));

    // Surfaces of the fragments enclose what they weigh, at the density of glass.
    double volume = 0;
    for (const BrittleBodyState& s : bodies) {
        uint32_t count = 0, outer = 0;
        brittleGetSurface(host, scene.world, s.body, nullptr, 0, &count, &outer);
        std::vector<BrittleVertex> v(count);
        MUST(host, brittleGetSurface(host, scene.world, s.body, v.data(), count, &count, &outer));
        EXPECT_LE(outer, count);
        for (size_t t = 0; !s.is_collider && t + 2 < v.size(); t += 3) {
            const auto p = [&](size_t k, size_t axis) { return double{v[t + k].position[axis]}; };
            for (size_t x = 0; x < 3; ++x)
                volume += p(0, x) * (p(1, (x + 1) % 3) * p(2, (x + 2) % 3) - p(1, (x + 2) % 3) * p(2, (x + 1) % 3)) / 6;
        }
    }
    EXPECT_NEAR(volume, (mass - b.dust_mass) / whole.mass * 0.008, 1e-6);
    const BrittleCounts counts = countsOf(host, scene.world);
    EXPECT_EQ(counts.broken, 1u);
    EXPECT_EQ(counts.fragments, b.fragments);
    EXPECT_EQ(counts.breaks_lost, 0u);
}

TEST(AbiWorld, TellsOfWhatWasHitAndDidNotBreak) {
    const Hosting host;
    const BrittleBodyDef def = glassCube(host, 0.2);
    const Scene scene = makeScene(host, {def});
    MUST(host, brittleStep(host, scene.world, 40));
    EXPECT_TRUE(breaksOf(host, scene.world).empty()) << "it falls from too low";
    BrittleImpact impacts[8];
    uint32_t count = 0;
    MUST(host, brittleGetImpacts(host, scene.world, impacts, 8, &count));
    ASSERT_GE(count, 1u);
    const BrittleImpact& i = impacts[0];
    const size_t cube = i.bodies[0].id == scene.bodies[0].id ? 0 : 1;
    EXPECT_EQ(i.bodies[cube].id, scene.bodies[0].id);
    EXPECT_EQ(i.origins[cube].id, scene.bodies[0].id);
    EXPECT_EQ(i.materials[cube].id, def.material.id);
    EXPECT_EQ(i.bodies[1 - cube].id, scene.ground.id);
    EXPECT_EQ(i.materials[1 - cube].id, 0u);
    EXPECT_GE(i.points, 1u);
    EXPECT_NEAR(i.position.y, 0, 0.02);
    EXPECT_NEAR(std::abs(i.normal.y), 1, 1e-3);
    EXPECT_NEAR(i.energy, 0.5 * i.effective_mass * i.speed * i.speed, 1e-4 * i.energy);
    EXPECT_GT(i.impulse, 0);
    MUST(host, brittleGetImpacts(host, scene.world, impacts, 8, &count));
    EXPECT_EQ(count, 0u) << "each is told once";
    EXPECT_EQ(brittleGetImpacts(host, scene.world, nullptr, 8, &count), BRITTLE_NULL_ARGUMENT);
    EXPECT_EQ(brittleGetImpacts(host, scene.world, impacts, 8, nullptr), BRITTLE_NULL_ARGUMENT);
    EXPECT_EQ(countsOf(host, scene.world).impacts_lost, 0u);
}

// Of one body and of all of them, with the ground among them.
TEST(AbiWorld, GivesSeveralSurfacesAsItGivesEach) {
    const Hosting host;
    const Scene scene = makeScene(host, {glassCube(host, 1)});
    MUST(host, brittleStep(host, scene.world, 40));
    std::vector<BrittleBody> bodies;
    std::vector<std::byte> each;
    std::vector<uint32_t> counts, outers;
    for (const BrittleBodyState& s : bodiesOf(host, scene.world)) {
        std::vector<BrittleVertex> v(5000);
        bodies.push_back(s.body);
        MUST(host,
             brittleGetSurface(host, scene.world, s.body, v.data(), 5000, &counts.emplace_back(), &outers.emplace_back()));
        const auto* bytes = reinterpret_cast<const std::byte*>(v.data());
        each.insert(each.end(), bytes, bytes + counts.back() * sizeof v[0]);
    }
    ASSERT_GT(bodies.size(), 2u);
    const auto number = static_cast<uint32_t>(bodies.size());
    std::vector<uint32_t> counts_of_all(number), outers_of_all(number);
    uint32_t total = 0;
    EXPECT_EQ(brittleGetSurfaces(host, scene.world, bodies.data(), number, nullptr, 0, &total, counts_of_all.data(),
                                 outers_of_all.data()),
              BRITTLE_BUFFER_TOO_SMALL);
    ASSERT_EQ(total * sizeof(BrittleVertex), each.size());
    std::vector<BrittleVertex> all(total);
    MUST(host, brittleGetSurfaces(host, scene.world, bodies.data(), number, all.data(), total, &total, counts_of_all.data(),
                                  outers_of_all.data()));
    EXPECT_EQ(counts_of_all, counts);
    EXPECT_EQ(outers_of_all, outers);
    EXPECT_EQ(std::memcmp(all.data(), each.data(), each.size()), 0);
    MUST(host, brittleGetSurfaces(host, scene.world, nullptr, 0, nullptr, 0, &total, nullptr, nullptr));
    EXPECT_EQ(total, 0u);
    EXPECT_EQ(brittleGetSurfaces(host, scene.world, bodies.data(), number, all.data(), 1, &total, nullptr, outers.data()),
              BRITTLE_NULL_ARGUMENT);
    bodies[1] = scene.bodies[0];
    EXPECT_EQ(
        brittleGetSurfaces(host, scene.world, bodies.data(), number, all.data(), total, &total, counts.data(), outers.data()),
        BRITTLE_STALE_HANDLE);
    bodies[1].id ^= 1ull << 50;
    EXPECT_EQ(
        brittleGetSurfaces(host, scene.world, bodies.data(), number, all.data(), total, &total, counts.data(), outers.data()),
        BRITTLE_WRONG_HANDLE);
}

TEST(AbiWorld, GoesOnFromASavedStateBitForBit) {
    const Hosting host;
    const Scene scene = makeScene(host, {glassCube(host, 1)});
    MUST(host, brittleStep(host, scene.world, 20));
    size_t size = 0, again = 0;
    MUST(host, brittleSaveState(host, scene.world, nullptr, 0, &size));
    std::vector<std::byte> state(size);
    EXPECT_EQ(brittleSaveState(host, scene.world, state.data(), size - 1, &again), BRITTLE_BUFFER_TOO_SMALL);
    EXPECT_EQ(again, size);
    MUST(host, brittleSaveState(host, scene.world, state.data(), size, &again));
    MUST(host, brittleStep(host, scene.world, 20));
    const uint64_t first = hashOf(host, scene.world);
    EXPECT_EQ(breaksOf(host, scene.world).size(), 1u);
    MUST(host, brittleRestoreState(host, scene.world, state.data(), size));
    EXPECT_NE(hashOf(host, scene.world), first);
    MUST(host, brittleStep(host, scene.world, 20));
    EXPECT_EQ(hashOf(host, scene.world), first);
    EXPECT_EQ(breaksOf(host, scene.world).size(), 1u) << "it has happened again";
    // What is no such state changes nothing.
    EXPECT_EQ(brittleRestoreState(host, scene.world, state.data(), size - 1), BRITTLE_BAD_STATE);
    EXPECT_EQ(brittleRestoreState(host, scene.world, state.data(), 3), BRITTLE_BAD_STATE);
    EXPECT_EQ(brittleRestoreState(host, scene.world, state.data(), SIZE_MAX), BRITTLE_BAD_STATE)
        << "nothing past its end is read";
    for (const size_t at : {size_t{0}, size_t{20}, size / 2, size - 1}) {
        auto broken = state;
        broken[at] ^= std::byte{1};
        EXPECT_EQ(brittleRestoreState(host, scene.world, broken.data(), size), BRITTLE_BAD_STATE) << at;
    }
    EXPECT_EQ(hashOf(host, scene.world), first);
}

// A budget that was given and is too small: the code, the name, and the world as it was.
TEST(AbiWorld, SaysWhichBudgetIsTooSmall) {
    const Hosting host;
    BrittleWorldDef def = plainDef();
    def.budget.pairs = 1;
    std::vector<BrittleBodyDef> cubes(3, brittleDefaultBodyDef());
    for (size_t k = 0; k < 3; ++k)
        cubes[k].position.y = 0.5 + static_cast<double>(k);
    const Scene scene = makeScene(host, cubes, def);
    EXPECT_EQ(brittleStep(host, scene.world, 1), BRITTLE_CAPACITY);
    EXPECT_NE(host.error().find("pairs"), std::string::npos) << host.error();
}

// 1,398,101 triangles of 96 bytes fill what lavapipe can bind at once; the cube's own twelve come on top.
TEST(AbiWorld, WhoseSurfacesTheDeviceCannotBindIsRefused) {
    const Hosting host;
    for (const uint32_t triangles : {1'398'000u, 1'398'101u, 1'398'102u, 4'194'304u}) {
        BrittleWorldDef def = brittleDefaultWorldDef();
        def.budget.fragment_triangles = triangles;
        const Scene scene = makeScene(host, {glassCube(host, 1)}, def, false);
        const BrittleResult started = brittleStartWorld(host, scene.world);
        EXPECT_TRUE(started == BRITTLE_OK || started == BRITTLE_CAPACITY) << brittleResultName(started) << ": " << host.error();
        const bool says_what_to_do = host.error().find("lower the budget") != std::string::npos;
        EXPECT_TRUE(started == BRITTLE_OK || says_what_to_do) << host.error();
        EXPECT_TRUE(started == BRITTLE_OK || triangles > 1'398'000u) << host.error();
        MUST(host, brittleDestroyWorld(host, scene.world));
    }
}

TEST(AbiWorld, MovesMeshesByTheirCells) {
    const Hosting host;
    const HostMesh cube = cubeMesh(1);
    const BrittleMeshDef mesh_def = cube.def();
    BrittleBodyDef body = brittleDefaultBodyDef();
    MUST(host, brittleCreateMesh(host, &mesh_def, &body.shape.mesh));
    body.shape.kind = BRITTLE_SHAPE_MESH;
    body.shape.cells = 4;
    body.position.y = 0.6;
    BrittleWorldDef def = plainDef();
    const Scene scene = makeScene(host, {body}, def);
    MUST(host, brittleDestroyMesh(host, body.shape.mesh));
    MUST(host, brittleStep(host, scene.world, 60));
    BrittleBodyState state;
    MUST(host, brittleGetBody(host, scene.world, scene.bodies[0], &state));
    EXPECT_NEAR(state.position.y, 0.5, 0.01) << "it lies on the ground";
    EXPECT_NEAR(state.mass, 1000, 0.1);
}

} // namespace
