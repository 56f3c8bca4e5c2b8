// join_films, settle_films and merge_films: pieces as thin as a step of the grid become part of what they lie
// against, and no volume is lost.
#include "tests/kernel/device_event.h"
#include "tests/support/shapes.h"

#include "shaders-spirv/shared/fragment_record.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace kernel_test {
namespace {

using brittle::FractureOptions;
using brittle::FragmentRecord;
using reference::Point;
using reference::operator-;
using reference::operator+;
using reference::operator*;

// A plate on z = 0, turned so that no face of it is on the grid.
struct Plate {
    double thickness;
    bool turned;
    Point place(const Point& p) const {
        if (!turned) return p;
        const double a = .7, b = .4, x = p[0] * std::cos(a) - p[1] * std::sin(a), y = p[0] * std::sin(a) + p[1] * std::cos(a);
        return {x, y * std::cos(b) - p[2] * std::sin(b), y * std::sin(b) + p[2] * std::cos(b)};
    }
    brittle::PreparedMesh solid() const {
        reference::Triangles box = support::boxTriangles({-.5, -.5, 0}, {.5, .5, thickness});
        for (reference::Triangle& t : box)
            for (Point& p : t)
                p = place(p);
        return solidOf(box);
    }
    // Sites inside, each with its images in both faces: these lie in bisectors, to within the snapping of sites.
    FractureOptions mirrored(uint32_t count) const {
        std::mt19937 random(count);
        std::uniform_real_distribution<double> in(0, 1);
        FractureOptions options;
        for (uint32_t k = 0; k < count; ++k) {
            const Point p = {in(random)-.5, in(random)-.5, in(random)*thickness};
            for (const double z : {p[2], -p[2], 2 * thickness - p[2]})
                options.given_sites.push_back(place({p[0], p[1], z}));
        }
        return options;
    }
};

struct Outcome {
    const DeviceEvent& event;
    const brittle::EventBuffers& b = event.buffers();
    uint32_t count = event[COUNT_COMPONENTS];
    std::vector<Word2> fates = event.read<Word2>(b.fates, count);
    std::vector<FragmentRecord> records = event.read<FragmentRecord>(b.records, count);
    std::vector<uint32_t> films = event.read<uint32_t>(b.films, event[COUNT_FILMS]);
    std::vector<uint32_t> start = event.read<uint32_t>(b.component_start, count + 1);
    std::vector<uint32_t> order = event.read<uint32_t>(b.values, event[COUNT_VALID]);
    std::vector<Word4> pieces = event.read<Word4>(b.pieces, event[COUNT_TRIANGLES]);
    std::vector<std::array<float, 4>> positions = event.read<std::array<float, 4>>(b.positions, event[COUNT_POINTS]);

    reference::Triangles trianglesOf(uint32_t c) const { // in box units
        reference::Triangles triangles;
        for (uint32_t k = start[c]; k < start[c + 1]; ++k) {
            reference::Triangle t;
            for (size_t corner = 0; corner < 3; ++corner)
                for (size_t axis = 0; axis < 3; ++axis)
                    t[corner][axis] = double(positions[pieces[order[k]][corner]][axis]) * double(event.grid().unit());
            triangles.push_back(t);
        }
        return triangles;
    }
};

// In double, about the first corner.
double volumeOf(reference::Triangles triangles) {
    const Point origin = triangles.front().front();
    for (reference::Triangle& t : triangles)
        for (Point& p : t)
            p = p - origin;
    return reference::volumeOf(triangles);
}

void expectMeasured(const Outcome& o) {
    for (const uint32_t c : o.films) {
        const double area = reference::areaOf(o.trianglesOf(c));
        EXPECT_NEAR(o.records[c].measure[0], volumeOf(o.trianglesOf(c)), 1e-3 * area * double(brittle::EventGrid::kStep));
    }
}

// Of every piece, with the films that have become part of it, all corners lie within its cell, to within a few steps.
void expectAtHome(const Outcome& o) {
    constexpr double kStep = brittle::EventGrid::kStep;
    std::vector<Point> sites;
    for (const reference::GridPoint& s : o.event.sites())
        sites.push_back(kStep * Point{s[0] - double(1 << 23), s[1] - double(1 << 23), s[2] - double(1 << 23)});
    for (uint32_t c = 0; c < o.count; ++c) {
        const uint32_t cell = o.records[c].fate[2];
        for (const reference::Triangle& t : o.trianglesOf(c))
            for (const Point& p : t)
                for (uint32_t s = 0; s < sites.size(); ++s) {
                    const Point way = sites[s] - sites[cell], middle = .5 * (sites[s] + sites[cell]);
                    if (s == cell) continue;
                    ASSERT_LE(reference::dot(p - middle, way) / reference::length(way), 10 * kStep);
                }
    }
}

// Components are closed, and add up to the model.
void expectWhole(const Outcome& o) {
    double sum = 0;
    for (uint32_t c = 0; c < o.count; ++c) {
        std::map<Word2, int> sides;
        for (uint32_t k = o.start[c]; k < o.start[c + 1]; ++k)
            for (size_t side = 0; side < 3; ++side) {
                const Word4& piece = o.pieces[o.order[k]];
                const uint32_t a = piece[side], b = piece[(side + 1) % 3];
                sides[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
            }
        for (const auto& [side, net] : sides)
            ASSERT_EQ(net, 0) << "component " << c;
        sum += volumeOf(o.trianglesOf(c));
    }
    reference::Triangles model;
    for (const brittle::Index3& t : o.event.mesh().triangles) {
        reference::Triangle triangle;
        for (size_t k = 0; k < 3; ++k)
            for (size_t axis = 0; axis < 3; ++axis)
                triangle[k][axis] = double(o.event.mesh().positions[t[k]][axis]) * double(o.event.grid().unit());
        model.push_back(triangle);
    }
    EXPECT_NEAR(sum, volumeOf(model), 1e-6 * volumeOf(model));
}

void expectNothingLost(const Plate& plate, const FractureOptions& options) {
    SCOPED_TRACE(plate.thickness);
    const DeviceEvent event(plate.solid(), options, Until::Emission);
    const Outcome outcome{event};
    EXPECT_GT(event[COUNT_AGAIN], 0u) << "there were no films";
    EXPECT_EQ(event[STATUS_DISSOLVED], 0u);
    EXPECT_EQ(event[STATUS_JOINED] > 0, plate.thickness > 1e-6);
    for (const Word2& fate : outcome.fates)
        EXPECT_EQ(fate[0], FATE_FRAGMENT);
    expectMeasured(outcome);
    expectAtHome(outcome);
    expectWhole(outcome);
}

TEST(SmallFilms, OfImagesInTheFacesOfAPlateJoinThePiecesUnderThem) {
    for (const Plate& plate : {Plate{.2, true}, Plate{1e-2, true}, Plate{1e-5, false}})
        expectNothingLost(plate, plate.mirrored(40));
}

// All of it is thinner than a film may be: pieces with something in them are fragments nevertheless.
TEST(SmallFilms, ThatAreAllThereIsAreFragments) {
    FractureOptions options{0, 0, {{-.3, 0, 0}, {.1, .2, 0}, {.2, -.4, 0}}};
    const Plate plate{1e-7, false};
    expectNothingLost(plate, options);
    const brittle::PreparedMesh solid = plate.solid();
    EXPECT_EQ(DeviceEvent(solid, options, Until::Emission)[COUNT_FRAGMENTS], 3u);
}

} // namespace
} // namespace kernel_test
