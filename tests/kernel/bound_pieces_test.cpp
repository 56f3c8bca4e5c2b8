// bound_pieces: the box of a piece holds all of it, where it is and where it will be at the end of the step, however far out.
#include "modules/brittle/dynamics/hull_set.h"
#include "shaders-spirv/shared/broad_phase.h"
#include "tests/kernel/hull_scene.h"
#include "tests/kernel/solver_lab.h"

#include <algorithm>
#include <bit>
#include <numbers>

namespace kernel_test {
namespace {

constexpr double kStep = 1.0 / 60;
constexpr double kRelativeRounding = 1.0 / (1 << 22); // of a place: what boxes far out are wider by, and a step of a float more
constexpr double kNearRounding = 1e-5;                // m, within a few meters

struct Pieces {
    std::vector<Shape> shapes;
    std::vector<RigidBody> bodies;
    std::vector<Word2> pieces; // shape, body
};

struct Box {
    Vector low, high;
    uint32_t body = 0, flags = 0;
};

std::vector<Box> boxesOnDevice(const Pieces& in, double margin) {
    brittle::HullSet hulls;
    for (const Shape& shape : in.shapes)
        EXPECT_TRUE(brittle::addHull(hulls, shape.vertices, shape.loops));
    std::vector<gpu::PieceRecord> records;
    for (const auto& [shape, body] : in.pieces)
        records.push_back({{shape, body, 0, 0}});
    const auto count = static_cast<uint32_t>(records.size());
    Counts counts;
    counts[COUNT_BOXES] = count;
    const engine::Buffer pieces = bufferOf(records), states = bufferOf(statesOf(in.bodies)),
                         hull_records = bufferOf(hulls.records), vertices = bufferOf(hulls.vertices),
                         low = blankBuffer<gpu::vec4>(count), high = blankBuffer<gpu::vec4>(count);
    onDevice([&](engine::Commands& commands) {
        const std::array<float, 5> push = {0, 0, 0, static_cast<float>(kStep), static_cast<float>(margin)};
        commands.dispatch(kernel("bound_pieces"), count, push,
                          {counts.words, pieces, states, hull_records, vertices, low, high});
    });
    std::vector<Box> boxes;
    for (uint32_t p = 0; p < count; ++p) {
        const gpu::vec4 l = low.mappedAs<gpu::vec4>()[p], h = high.mappedAs<gpu::vec4>()[p];
        boxes.push_back({xyz(l), xyz(h), std::bit_cast<uint32_t>(l.w), std::bit_cast<uint32_t>(h.w)});
    }
    return boxes;
}

Quaternion turnThen(const RigidBody& body, double time) {
    const Vector spin = xyz(body.state.spin);
    return Quaternion(Eigen::AngleAxisd(time * spin.norm(), spin.norm() > 0 ? spin.normalized() : Vector::UnitX())) *
           turnOf(body.state.turn);
}

// Of the corners where they will be at these times, s; where they are, of what does not move.
Box boxAt(const Pieces& in, uint32_t piece, const std::vector<double>& times) {
    const RigidBody& body = in.bodies[in.pieces[piece][1]];
    Box box = {Vector::Constant(1e300), Vector::Constant(-1e300)};
    for (const double any_time : times)
        for (const brittle::Float3& v : in.shapes[in.pieces[piece][0]].vertices) {
            const double time = body.moves() ? any_time : 0;
            const Vector at = body.place() + turnThen(body, time) * Vector(v[0], v[1], v[2]) + time * xyz(body.state.velocity);
            box.low = box.low.cwiseMin(at);
            box.high = box.high.cwiseMax(at);
        }
    return box;
}

Box sweptBox(const Pieces& in, uint32_t piece) { return boxAt(in, piece, {0, kStep}); }

// Of the arcs of corners, beyond their chords, at most.
double bulgeOf(const Pieces& in, uint32_t piece) {
    const RigidBody& body = in.bodies[in.pieces[piece][1]];
    const Shape& shape = in.shapes[in.pieces[piece][0]];
    brittle::HullSet hulls;
    EXPECT_TRUE(brittle::addHull(hulls, shape.vertices, shape.loops));
    const gpu::vec4 ball = hulls.records[0].center;
    const double angle = body.moves() ? kStep * xyz(body.state.spin).norm() : 0;
    return (xyz(ball).norm() + ball.w) * (1 - std::cos(std::min(angle, 2 * std::numbers::pi) / 2));
}

void expectAround(const Box& box, const Box& swept, double margin) {
    for (int k = 0; k < 3; ++k) {
        const double far = std::max(std::fabs(swept.low[k]), std::fabs(swept.high[k]));
        const double slack = kNearRounding + 3 * kRelativeRounding * far;
        EXPECT_LE(box.low[k], swept.low[k] - margin + kNearRounding) << "axis " << k;
        EXPECT_GE(box.high[k], swept.high[k] + margin - kNearRounding) << "axis " << k;
        EXPECT_GE(box.low[k], swept.low[k] - margin - slack) << "axis " << k;
        EXPECT_LE(box.high[k], swept.high[k] + margin + slack) << "axis " << k;
    }
}

// Some bodies of one piece, some of three; every third does not move.
Pieces randomPieces(uint32_t count, uint32_t seed) {
    Chance chance(seed);
    Pieces made;
    for (uint32_t k = 0; k < 12; ++k)
        made.shapes.push_back(cellShape(chance.engine(), 4 + 3 * k, {0.5, 1, 0.7}));
    while (made.pieces.size() < count) {
        const auto body = static_cast<uint32_t>(made.bodies.size());
        made.bodies.push_back(randomBody(chance, body % 3 != 2));
        for (uint32_t k = 0; k < (body % 4 == 0 ? 3u : 1u) && made.pieces.size() < count; ++k)
            made.pieces.push_back({chance.below(12), body});
    }
    return made;
}

TEST(SmallBoundPieces, HoldThePieceNowAndAtTheEndOfTheStep) {
    for (const uint32_t count : kSizes)
        for (const double margin : {0.0, 0.01}) {
            const Pieces in = randomPieces(count, count);
            const std::vector<Box> boxes = boxesOnDevice(in, margin);
            for (uint32_t p = 0; p < count; ++p) {
                SCOPED_TRACE(p);
                expectAround(boxes[p], sweptBox(in, p), margin + bulgeOf(in, p));
            }
        }
}

// What turns by a third of a turn in a step, and by more than a whole one.
TEST(SmallBoundPieces, HoldThePieceOnTheWayHoweverFastItTurns) {
    Chance chance(6);
    for (const double spin : {5.0, 120.0, 500.0}) {
        Pieces in = randomPieces(60, 7);
        for (RigidBody& body : in.bodies)
            body.state.spin = wordsOf(spin * chance.direction());
        const std::vector<Box> boxes = boxesOnDevice(in, 0);
        for (uint32_t p = 0; p < 60; ++p)
            for (double share = 0; share <= 1; share += 1.0 / 64) {
                const Box then = boxAt(in, p, {share * kStep});
                EXPECT_LE((boxes[p].low - then.low).maxCoeff(), kNearRounding) << p << ", " << share;
                EXPECT_LE((then.high - boxes[p].high).maxCoeff(), kNearRounding) << p << ", " << share;
            }
    }
}

TEST(SmallBoundPieces, SayWhoseTheyAreAndWhetherTheyMove) {
    const Pieces in = randomPieces(200, 1);
    const std::vector<Box> boxes = boxesOnDevice(in, 0.01);
    for (uint32_t p = 0; p < 200; ++p) {
        EXPECT_EQ(boxes[p].body, in.pieces[p][1]);
        EXPECT_EQ(boxes[p].flags, in.bodies[in.pieces[p][1]].moves() ? 0u : BOX_STATIC);
    }
}

// What does not move may have a velocity all the same, as a conveyor belt's; its box is where it is.
TEST(SmallBoundPieces, OfWhatDoesNotMoveAreNotSwept) {
    Pieces in = randomPieces(3, 2);
    RigidBody& still = in.bodies.back();
    still.state.offset.w = 0;
    still.state.velocity = {600, 0, 0, 0};
    const uint32_t last = 2;
    expectAround(boxesOnDevice(in, 0)[last], sweptBox(in, last), 0);
}

TEST(SmallBoundPieces, OfFastOnesReachAsFarAsTheyGo) {
    Pieces in = randomPieces(40, 3);
    Chance chance(4);
    for (RigidBody& body : in.bodies)
        body.state.velocity = wordsOf(chance.between(10, 1000) * chance.direction());
    const std::vector<Box> boxes = boxesOnDevice(in, 0.01);
    for (uint32_t p = 0; p < 40; ++p) {
        SCOPED_TRACE(p);
        expectAround(boxes[p], sweptBox(in, p), 0.01 + bulgeOf(in, p));
    }
}

// There a float has steps of up to 6 cm, but no box is too small by any of them.
TEST(SmallBoundPieces, HoldAllOfAPieceThatIsFarFromTheOrigin) {
    for (const int32_t sectors : {100, -6250, 62'500}) {
        Pieces in = randomPieces(300, 5);
        for (RigidBody& body : in.bodies)
            body.state.sector = {sectors, -sectors, sectors / 3, 0};
        const std::vector<Box> boxes = boxesOnDevice(in, 0);
        for (uint32_t p = 0; p < 300; ++p) {
            SCOPED_TRACE(p);
            const Box swept = sweptBox(in, p);
            EXPECT_TRUE((boxes[p].low.array() <= swept.low.array()).all());
            EXPECT_TRUE((boxes[p].high.array() >= swept.high.array()).all());
            expectAround(boxes[p], swept, bulgeOf(in, p));
        }
    }
}

} // namespace
} // namespace kernel_test
