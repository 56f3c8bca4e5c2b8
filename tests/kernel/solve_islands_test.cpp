// solve_islands steps small islands by the laws of Newton and Coulomb, each on its own. Bodies are met at their centers of mass
// here, so none of them turns, and the laws are those of points.
#include "tests/kernel/solver_lab.h"

#include <algorithm>

namespace kernel_test {
namespace {

constexpr double kStep = 1.0 / 60, kGravity = 9.81;
constexpr uint32_t kSubsteps = 4;

struct Point {
    double mass = 0; // kg; 0: does not move
    Vector velocity = Vector::Zero();
};

struct Contact {
    uint32_t a = 0, b = 0;
    Vector normal = Vector::UnitY(); // from A to B
    double apart = 0, friction = 0;
    uint32_t color = 0;
};

// Contacts stand color by color.
struct Island {
    std::vector<Point> points;
    std::vector<Contact> contacts;
};

double massBetween(const Point& a, const Point& b) {
    const double inverse_a = a.mass > 0 ? 1 / a.mass : 0, inverse_b = b.mass > 0 ? 1 / b.mass : 0;
    return 1 / (inverse_a + inverse_b);
}

gpu::SolverContact solverContactOf(const Island& island, const Contact& from, uint32_t first_body) {
    const double mass = massBetween(island.points[from.a], island.points[from.b]);
    const bool both_move = island.points[from.a].mass > 0 && island.points[from.b].mass > 0;
    gpu::SolverContact contact{};
    contact.ids = {first_body + from.a, first_body + from.b, 1, 0};
    contact.normal = wordsOf(from.normal, from.friction);
    contact.tangent = wordsOf(from.normal.unitOrthogonal());
    contact.rub_mass = wordsOf(Vector(mass, 0, mass), both_move ? ARMS_OF_A_FOLLOW : ARMS_STAY);
    contact.rub.w = 3; // m/s, the most push
    contact.press[0].x = static_cast<float>(mass);
    contact.points[0].arm_a.w = static_cast<float>(from.apart);
    contact.points[0].arm_b.w = static_cast<float>(mass);
    contact.points[0].pulse.w = POINT_FREE;
    return contact;
}

RigidBody bodyOf(const Point& point) {
    RigidBody body;
    body.state.offset.w = point.mass > 0 ? static_cast<float>(1 / point.mass) : 0;
    body.state.velocity = wordsOf(point.velocity);
    body.state.turn = {0, 0, 0, 1};
    for (int axis = 0; axis < 3; ++axis) {
        float* row = &body.shape.inverse_inertia[axis].x;
        row[axis] = 10 * body.state.offset.w;
    }
    body.shape.inverse_inertia[2].w = 0.5; // radius, m
    const float half_thickness = 0.5;
    std::memcpy(&body.shape.pieces.z, &half_thickness, sizeof half_thickness);
    return body;
}

// All islands in one step, as the stages before leave them.
struct Input {
    std::vector<RigidBody> bodies;
    std::vector<gpu::SolverContact> contacts;
    std::vector<uint32_t> color_ends, adjacency_start = {0}, adjacency;
    std::vector<Word2> ranges;

    void add(const Island& island) {
        const auto first_body = static_cast<uint32_t>(bodies.size()), first = static_cast<uint32_t>(contacts.size());
        const auto count = static_cast<uint32_t>(island.contacts.size());
        for (const Point& point : island.points)
            bodies.push_back(bodyOf(point));
        for (const Contact& contact : island.contacts)
            contacts.push_back(solverContactOf(island, contact, first_body));
        for (uint32_t c = 0; c < count; ++c)
            color_ends.push_back(first + endOfColor(island, c));
        for (uint32_t b = 0; b < island.points.size(); ++b)
            addAdjacency(first_body + b, first, first + count);
        ranges.push_back({first, first + count});
    }

private:
    static uint32_t endOfColor(const Island& island, uint32_t c) {
        uint32_t end = c;
        while (end < island.contacts.size() && island.contacts[end].color == island.contacts[c].color)
            ++end;
        return end;
    }
    void addAdjacency(uint32_t body, uint32_t first, uint32_t end) {
        for (uint32_t c = first; c < end && bodies[body].moves(); ++c) {
            if (contacts[c].ids.x == body) adjacency.push_back(2 * c);
            if (contacts[c].ids.y == body) adjacency.push_back(2 * c + 1);
        }
        adjacency_start.push_back(static_cast<uint32_t>(adjacency.size()));
    }
};

struct Output {
    std::vector<gpu::SolverBody> bodies;
    std::vector<gpu::SolverContact> contacts;
    Vector velocity(uint32_t body) const { return xyz(bodies[body].velocity); }
};

gpu::PacePush pushOf(double gravity) {
    gpu::PacePush push{};
    push.gravity = wordsOf(Vector(0, -gravity, 0), kStep);
    push.hertz = 1e30F;
    push.damping = 10;
    push.least_bounce = 1;
    push.substeps = kSubsteps;
    push.most_substeps = 64;
    push.iterations = 1;
    push.parts = 1;
    push.most_parts = ISLAND_PARTS;
    push.stiffer = 1;
    return push;
}

Output solved(const char* name, const Input& in, double gravity) {
    const auto body_count = static_cast<uint32_t>(in.bodies.size()), contact_count = static_cast<uint32_t>(in.contacts.size());
    Counts counts;
    std::vector<uint32_t> color_start(COLOR_WORDS);
    color_start[ISLANDS_APART] = static_cast<uint32_t>(in.ranges.size());
    const engine::Buffer starts = bufferOf(color_start), ranges = bufferOf(in.ranges), ends = bufferOf(in.color_ends),
                         adjacency_start = bufferOf(in.adjacency_start), adjacency = bufferOf(in.adjacency),
                         steps = bufferOf(std::vector<uint32_t>{1, 0, 0, 0}), shapes = bufferOf(shapesOf(in.bodies)),
                         contacts = bufferOf(in.contacts), solver_bodies = bufferOf(solverBodiesOf(in.bodies)),
                         bodies = bufferOf(statesOf(in.bodies)), spins = bufferOf(std::vector<gpu::vec4>(body_count)),
                         heights = bufferOf(std::vector<uint32_t>(body_count)),
                         members = blankBuffer<uint32_t>(4 * contact_count);
    onDevice([&](engine::Commands& commands) {
        commands.dispatchGroups(kernel(name), static_cast<uint32_t>(in.ranges.size()), pushOf(gravity),
                                {counts.words, starts, ranges, ends, adjacency_start, adjacency, steps, shapes, contacts,
                                 solver_bodies, bodies, spins, heights, members, counts.args});
    });
    return {valuesOf<gpu::SolverBody>(solver_bodies, body_count), valuesOf<gpu::SolverContact>(contacts, contact_count)};
}

// Each touches the next one. Links take two colors in turn.
Island chainOf(uint32_t links, double apart, Chance& chance) {
    Island island;
    for (uint32_t b = 0; b <= links; ++b)
        island.points.push_back({chance.between(1, 2), chance.inBox(3)});
    for (const uint32_t color : {0u, 1u})
        for (uint32_t k = color; k < links; k += 2)
            island.contacts.push_back({k, k + 1, chance.direction(), apart, 0, color});
    return island;
}

// One point on what does not move.
Island lyingPoint(double mass, const Vector& velocity, double friction) {
    return {{{0, Vector::Zero()}, {mass, velocity}}, {{0, 1, Vector::UnitY(), 0, friction, 0}}};
}

class SmallSolveIslands : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Lanes, SmallSolveIslands, testing::Values("solve_islands", "solve_islands_wide"),
                         [](const auto& lanes) { return std::string(lanes.param) == "solve_islands" ? "few" : "many"; });

// Islands are numbered as they come, and so are their ranges: the two orders differ where many lanes number them at once.
TEST_P(SmallSolveIslands, MoveEachBodyOnceASubstepInWhateverOrderTheirRangesStand) {
    Chance chance(3);
    Input in;
    for (uint32_t k = 0; k < 60; ++k)
        in.add(chainOf(1 + chance.below(12), 100, chance));
    std::ranges::shuffle(in.ranges, chance.engine());
    const Output out = solved(GetParam(), in, kGravity);
    for (uint32_t b = 0; b < in.bodies.size(); ++b) {
        const double made = out.contacts[in.adjacency[in.adjacency_start[b]] / 2].pace.y;
        const Vector before = xyz(in.bodies[b].state.velocity), falls(0, -kGravity * kStep, 0);
        EXPECT_LE((out.velocity(b) - before - falls).norm(), 1e-5) << b;
        EXPECT_LE((xyz(out.bodies[b].moved) - kStep * (before + 0.5 * (1 + 1 / made) * falls)).norm(), 1e-6) << b;
    }
}

TEST_P(SmallSolveIslands, LeaveBodiesThatMeetWithTheSpeedOfTheirCommonCenter) {
    Chance chance(4);
    Input in;
    for (uint32_t k = 0; k < 20; ++k) {
        const Vector normal = chance.direction();
        Island pair = {{{chance.between(0.1, 10), chance.between(0, 5) * normal},
                        {chance.between(0.1, 10), chance.between(-5, 0) * normal}},
                       {{0, 1, normal, 0, 0.5, 0}}};
        in.add(pair);
    }
    const Output out = solved(GetParam(), in, 0);
    for (uint32_t b = 0; b < in.bodies.size(); ++b) {
        const RigidBody &one = in.bodies[b], &other = in.bodies[b ^ 1u];
        const double mass = 1 / double{one.state.offset.w}, others = 1 / double{other.state.offset.w};
        const Vector common = (mass * xyz(one.state.velocity) + others * xyz(other.state.velocity)) / (mass + others);
        EXPECT_LE((out.velocity(b) - common).norm(), 1e-5) << b;
    }
}

TEST_P(SmallSolveIslands, HoldWhatLiesOnTheGroundByItsWeight) {
    Input in;
    for (const double mass : {0.001, 1.0, 1e5})
        in.add(lyingPoint(mass, Vector::Zero(), 0.5));
    const Output out = solved(GetParam(), in, kGravity);
    for (uint32_t k = 0; k < 3; ++k) {
        const double mass = 1 / double{in.bodies[2 * k + 1].state.offset.w}, substeps = out.contacts[k].pace.y;
        EXPECT_LE(out.velocity(2 * k + 1).norm(), 1e-5) << k;
        EXPECT_LE(xyz(out.bodies[2 * k + 1].moved).norm(), 1e-4) << k;
        EXPECT_NEAR(out.contacts[k].points[0].pulse.x * substeps / (mass * kGravity * kStep), 1, 1e-3) << k;
        EXPECT_EQ(xyz(out.bodies[2 * k].velocity), Vector::Zero());
    }
}

TEST_P(SmallSolveIslands, SlowWhatSlidesByTheLawOfCoulomb) {
    Input in;
    const double speed = 2;
    for (const double friction : {0.0, 0.1, 0.6, 100.0})
        in.add(lyingPoint(2, Vector(0.6, 0, 0.8) * speed, friction));
    const Output out = solved(GetParam(), in, kGravity);
    for (uint32_t k = 0; k < 4; ++k) {
        const double friction = in.contacts[k].normal.w, left = std::max(speed - friction * kGravity * kStep, 0.0);
        EXPECT_LE((out.velocity(2 * k + 1) - Vector(0.6, 0, 0.8) * left).norm(), 1e-3 * speed) << friction;
    }
}

} // namespace
} // namespace kernel_test
