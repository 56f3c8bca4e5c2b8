#include "tests/hard/hard_worlds.h"

#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/dynamics/scene_contents.h"
#include "modules/brittle/dynamics/scene_settings.h"

#include <cmath>

namespace hard {
namespace {

using brittle::World, brittle::WorldBudget;

constexpr double kBall = 0.1;              // m, radius
constexpr uint32_t kFall = 60, kRest = 60; // steps

constexpr PoolCase kPoolCases[] = {
    {"room for one fragment",
     [](WorldBudget& b) {
         b.breaking.fragments = 1;
         b.breaking.faces = 40000;
         b.breaking.triangles = 90000;
     },
     WHOLE_NO_ROOM,
     {true, true, false, false}},
    {"full pool of faces", [](WorldBudget& b) { b.breaking.faces = 100; }, WHOLE_NO_ROOM, {false, false, true, false}},
    {"full pool of triangles", [](WorldBudget& b) { b.breaking.triangles = 300; }, WHOLE_NO_ROOM, {false, false, false, true}},
    {"full pools of faces and triangles",
     [](WorldBudget& b) {
         b.breaking.faces = 4;
         b.breaking.triangles = 300;
     },
     WHOLE_NO_ROOM,
     {false, false, true, true}},
    {"no room for the triangles of a step",
     [](WorldBudget& b) { b.breaking.step_triangles = 8; },
     WHOLE_TOO_LARGE,
     {true, false, false, false}},
    {"no room for the pairs of fragments", [](WorldBudget& b) { b.pairs = 8; }, WHOLE_NO_PAIRS, {true, true, false, false}},
    {"no room for the contacts of fragments",
     [](WorldBudget& b) { b.contacts = 8; },
     WHOLE_NO_PAIRS,
     {false, true, false, false}},
};

brittle::SceneDescription fallingBall() {
    brittle::SceneDescription scene;
    scene.effects = {"gravity", "contacts", "friction", "impact_fracture", "events"};
    brittle::BodyDescription& ball = scene.bodies.emplace_back();
    ball.shape.kind = brittle::ShapeKind::Ball;
    ball.shape.radius = kBall;
    ball.place = {0, 3, 0};
    ball.material = "glass";
    scene.colliders.emplace_back();
    return scene;
}

std::unique_ptr<World> worldOf(Trial& trial, const brittle::SceneDescription& scene, const WorldBudget& budget) {
    const auto contents = brittle::contentsOf(scene, {}, nullptr);
    const auto settings = brittle::settingsOf(scene);
    if (!contents || !settings) {
        trial.fail(contents ? settings.error().message : contents.error().message);
        return nullptr;
    }
    auto world = World::create(trial.device(), *contents, *settings, budget);
    if (world) return std::move(*world);
    trial.fail(world.error().message);
    return nullptr;
}

// Steps until something is told; no more than it takes to fall.
std::vector<gpu::BreakEvent> eventsOf(Trial& trial, World& world) {
    for (uint32_t k = 0; k < kFall && !trial.failure(); ++k) {
        if (const auto done = world.step(1); !done) trial.fail(done.error().message);
        const auto breaks = world.breaks();
        if (!breaks) trial.fail(breaks.error().message);
        if (breaks && !breaks->events.empty()) return breaks->events;
    }
    return {};
}

void checkEvent(Trial& trial, const PoolCase& self, const gpu::BreakEvent& event) {
    const uint32_t lacked[POOLS] = {event.lacked.x, event.lacked.y, event.lacked.z, event.lacked.w};
    double wrong = 0;
    for (size_t k = 0; k < POOLS; ++k)
        wrong += (lacked[k] > 0) == self.lacks[k] ? 0 : 1;
    trial.check("fragments made", event.made.x, 0);
    trial.check("events with another reason", event.made.y == self.why ? 0 : 1, 0);
    trial.check("pools of which the event says what is not so", wrong, 0);
}

void checkBall(Trial& trial, World& world) {
    const auto bodies = world.bodies();
    if (!bodies) return trial.fail(bodies.error().message);
    double present = 0, height = 0;
    for (const gpu::BodyState& body : *bodies) {
        if ((body.sector.w & BODY_ABSENT) != 0 || body.offset.w == 0) continue;
        ++present;
        height = brittle::poseOf(body).place[1];
    }
    trial.check("bodies, off from the one there was", std::fabs(present - 1), 0);
    trial.check("height of the whole ball, off", std::fabs(height - kBall), 0.02, "m");
}

} // namespace

std::span<const PoolCase> poolCases() { return kPoolCases; }

void measurePool(Trial& trial, const PoolCase& self) {
    WorldBudget budget;
    self.shrink(budget);
    const auto world = worldOf(trial, fallingBall(), budget);
    if (!world) return;
    const auto events = eventsOf(trial, *world);
    trial.check("events, off from one", std::fabs(static_cast<double>(events.size()) - 1), 0);
    if (trial.failure() || events.empty()) return;
    checkEvent(trial, self, events[0]);
    if (const auto done = world->step(kRest); !done) return trial.fail(done.error().message);
    checkBall(trial, *world);
}

} // namespace hard
