// Piles of hulls: milliseconds a step, what each stage has of it, and how the pile lies in the end, ours and Bullet's.
#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/dynamics/scene_contents.h"
#include "modules/brittle/dynamics/scene_settings.h"
#include "modules/brittle/mesh/vector_math.h"
#include "modules/brittle/scene/library/builtin_scenes.h"
#include "tests/support/body_overlaps.h"
#include "tools/bench/bench.h"
#include "tools/bench/peer_bullet.h"
#include "tools/bench/phase_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace bench {
namespace {

using brittle::Double3;
using brittle::operator+, brittle::operator-, brittle::operator*;
using brittle::turnedBack, brittle::turnedBy;

constexpr uint32_t kBlock = 10, kBlocksTold = 10; // steps; blocks between two lines of progress

struct BulletMargin {
    const char* name;
    double margin; // m
};
constexpr BulletMargin kMargins[] = {{"bullet", 0.04}, {"bullet_5mm", 0.005}};

// Principal moments of a body that moves.
Double3 momentsOf(const gpu::BodyShape& shape) {
    return {1.0 / shape.inverse_inertia[0].x, 1.0 / shape.inverse_inertia[1].y, 1.0 / shape.inverse_inertia[2].z};
}

BodyMotion motionOf(const gpu::BodyState& body) {
    const support::Pose pose = support::poseOf(body);
    return {pose.place, pose.turn, xyz(body.velocity), xyz(body.spin)};
}

std::vector<BodyMotion> motionsOf(const std::vector<gpu::BodyState>& bodies) {
    std::vector<BodyMotion> motions;
    for (const gpu::BodyState& body : bodies)
        motions.push_back(motionOf(body));
    return motions;
}

// Bodies of a pile have one piece each.
SolidBody solidOf(const brittle::WorldContents& contents, size_t b) {
    const gpu::BodyShape& shape = contents.shapes[b];
    const gpu::HullRecord& hull = contents.hulls.records[contents.pieces[shape.pieces.x].ids.x];
    const BodyMotion motion = motionOf(contents.bodies[b]);
    SolidBody solid;
    for (uint32_t v = 0; v < hull.count.x; ++v)
        solid.corners.push_back(xyz(contents.hulls.vertices[hull.first.x + v]));
    solid.place = motion.place;
    solid.turn = motion.turn;
    solid.velocity = motion.velocity;
    solid.spin = motion.spin;
    solid.friction = shape.inverse_inertia[0].w;
    solid.restitution = shape.inverse_inertia[1].w;
    if (contents.bodies[b].offset.w == 0) return solid;
    solid.mass = 1.0 / contents.bodies[b].offset.w;
    solid.moments = momentsOf(shape);
    return solid;
}

double energyOf(const brittle::WorldContents& contents, size_t b, const BodyMotion& motion) {
    const Double3 own = turnedBack(motion.turn, motion.spin), moments = momentsOf(contents.shapes[b]);
    double twice = brittle::dot(motion.velocity, motion.velocity) / contents.bodies[b].offset.w;
    for (size_t k = 0; k < 3; ++k)
        twice += moments[k] * own[k] * own[k];
    return twice / 2;
}

bool hasEscaped(const brittle::SceneDescription& scene, const Double3& place) {
    return std::ranges::any_of(scene.colliders, [&](const brittle::ColliderDescription& plane) {
        return brittle::dot(turnedBy(plane.turn, {0, 1, 0}), place - plane.place) < 0;
    });
}

struct Pile {
    brittle::SceneDescription scene;
    brittle::WorldContents contents;
};

PileState stateOf(const Pile& pile, const std::vector<BodyMotion>& motions) {
    std::vector<support::Pose> poses;
    PileState state;
    double moving = 0;
    for (size_t b = 0; b < motions.size(); ++b) {
        poses.push_back({motions[b].place, motions[b].turn});
        if (pile.contents.bodies[b].offset.w == 0) continue;
        state.energy += energyOf(pile.contents, b, motions[b]);
        state.height += motions[b].place[1];
        state.escaped += hasEscaped(pile.scene, motions[b].place) ? 1 : 0;
        ++moving;
    }
    const std::vector<double> depths = support::overlapsOf(pile.contents, poses);
    state.penetration_p99 = support::percentile(depths, 0.99);
    state.penetration_most = support::percentile(depths, 1);
    state.overlaps = depths.size();
    state.height /= moving;
    return state;
}

struct Peer {
    PilePeer row;
    std::unique_ptr<BulletWorld> world;
};

std::vector<Peer> peersOf(const brittle::WorldContents& contents, const Double3& gravity) {
    std::vector<SolidBody> bodies;
    for (size_t b = 0; b < contents.bodies.size(); ++b)
        bodies.push_back(solidOf(contents, b));
    std::vector<Peer> peers;
    for (const BulletMargin& margin : kMargins)
        if (auto world = BulletWorld::create(bodies, gravity, margin.margin))
            peers.push_back({{margin.name, 0, {}}, std::move(world)});
    return peers;
}

double milliseconds(auto&& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

// Two steps make drivers compile what they have put off; then everything is as it was.
engine::Result<void> warmUp(brittle::World& world) {
    const auto start = world.save();
    if (!start) return start.error();
    if (auto done = world.step(2); !done) return done;
    return world.restore(*start);
}

void addTo(Times& sums, const std::vector<engine::Timing>& timings) {
    for (const engine::Timing& timing : timings) {
        auto known = std::ranges::find(sums, timing.name, &Times::value_type::first);
        if (known == sums.end())
            sums.emplace_back(timing.name, timing.ms);
        else
            known->second += timing.ms;
    }
}

engine::Result<void> runBlock(brittle::World& world, std::vector<Peer>& peers, double dt, uint32_t steps, PileRow& row) {
    engine::Result<void> done;
    row.ms += milliseconds([&] { done = world.step(steps); });
    if (!done) return done;
    for (Peer& peer : peers)
        peer.row.ms += milliseconds([&] { peer.world->step(dt, steps); });
    const auto timings = world.timings();
    if (!timings) return timings.error();
    addTo(row.stages, *timings);
    row.steps += steps;
    return {};
}

engine::Result<void> runAll(brittle::World& world, std::vector<Peer>& peers, double dt, uint32_t steps, PileRow& row,
                            const Progress& progress) {
    uint32_t blocks = 0;
    for (; row.steps < steps; ++blocks) {
        if (blocks % kBlocksTold == 0)
            progress("pile of " + std::to_string(row.bodies) + ": " + std::to_string(row.steps) + " of " +
                     std::to_string(steps) + " steps");
        if (auto done = runBlock(world, peers, dt, std::min(kBlock, steps - row.steps), row); !done) return done;
    }
    row.ms /= row.steps;
    for (Peer& peer : peers)
        peer.row.ms /= row.steps;
    for (auto& [name, ms] : row.stages)
        ms /= blocks;
    return {};
}

engine::Result<void> describeEnd(brittle::World& world, const Pile& pile, std::vector<Peer>& peers, PileRow& row) {
    const auto bodies = world.bodies();
    if (!bodies) return bodies.error();
    const auto counts = world.counts();
    if (!counts) return counts.error();
    row.dispatches = world.dispatches();
    row.pairs = counts->pairs;
    row.contacts = counts->contacts;
    row.colors = counts->colors;
    row.state = stateOf(pile, motionsOf(*bodies));
    for (Peer& peer : peers) {
        peer.row.state = stateOf(pile, peer.world->motions());
        row.peers.push_back(peer.row);
    }
    return {};
}

engine::Result<Pile> makePile(uint32_t count) {
    auto scene = brittle::makeBuiltinScene("hull_pile_" + std::to_string(count));
    if (!scene) return scene.error();
    auto contents = brittle::contentsOf(*scene, ".", nullptr);
    if (!contents) return contents.error();
    return Pile{std::move(*scene), std::move(*contents)};
}

engine::Result<PileRow> benchPile(engine::Device& device, uint32_t count, const BenchOptions& options,
                                  const Progress& progress) {
    const auto pile = makePile(count);
    if (!pile) return pile.error();
    const auto settings = brittle::settingsOf(pile->scene);
    if (!settings) return settings.error();
    auto world = brittle::World::create(device, pile->contents, *settings, brittle::budgetOf(pile->scene, options.group_size));
    if (!world) return world.error();
    std::vector<Peer> peers;
    if (options.peers) peers = peersOf(pile->contents, settings->gravity);
    PileRow row;
    row.bodies = count;
    progress("pile of " + std::to_string(count) + ": the first step compiles");
    if (auto done = warmUp(**world); !done) return done.error();
    if (auto done = runAll(**world, peers, settings->dt, options.pile_steps, row, progress); !done) return done.error();
    progress("pile of " + std::to_string(count) + ": overlaps in double precision");
    if (auto done = describeEnd(**world, *pile, peers, row); !done) return done.error();
    return row;
}

} // namespace

engine::Result<std::vector<PileRow>> benchPiles(engine::Device& device, const BenchOptions& options, const Progress& progress) {
    std::vector<PileRow> rows;
    for (const uint32_t count : options.pile_counts) {
        auto row = benchPile(device, count, options, progress);
        if (!row) return row.error();
        rows.push_back(std::move(*row));
    }
    return rows;
}

} // namespace bench
