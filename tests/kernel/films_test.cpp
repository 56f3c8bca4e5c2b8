// measure_films, join_films, settle_films and the list of parts: pieces as thin as a step of the grid become part of what they
// lie against, and no volume is lost.
#include "tests/kernel/device_event.h"
#include "tests/support/shapes.h"

#include "shaders-spirv/shared/fragment_record.h"

#include <algorithm>
#include <cmath>
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

    bool isJoined(uint32_t c) const { return fates[c][0] >= FATE_JOINED; }
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

// Every film has become part of a fragment within whose cell it lies, to within a few steps.
void expectAtHome(const Outcome& o) {
    const std::vector<reference::GridPoint> sites = o.event.sites();
    const auto siteOf = [&](uint32_t s) {
        return double(brittle::EventGrid::kStep) *
               Point{sites[s][0] - double(1 << 23), sites[s][1] - double(1 << 23), sites[s][2] - double(1 << 23)};
    };
    for (const uint32_t c : o.films) {
        if (!o.isJoined(c)) continue;
        const uint32_t host = o.fates[c][1];
        ASSERT_EQ(o.fates[host][0], FATE_FRAGMENT);
        const Point own = siteOf(o.records[host].fate[2]);
        for (const reference::Triangle& t : o.trianglesOf(c))
            for (const Point& p : t)
                for (uint32_t s = 0; s < sites.size(); ++s) {
                    const Point way = siteOf(s) - own, middle = .5 * (siteOf(s) + own);
                    if (s == o.records[host].fate[2]) continue;
                    ASSERT_LE(reference::dot(p - middle, way) / reference::length(way), 10 * double(brittle::EventGrid::kStep));
                }
    }
}

void expectPartsListed(const Outcome& o) {
    std::vector<Word2> expected;
    for (uint32_t c = 0; c < o.count; ++c)
        if (o.isJoined(c) || o.fates[c][0] == FATE_CAVITY) expected.push_back({o.fates[c][1], c});
    std::sort(expected.begin(), expected.end());
    ASSERT_EQ(o.event[COUNT_PARTS], expected.size());
    const auto parts = o.event.read<uint32_t>(o.b.parts, expected.size());
    const auto owners = o.event.read<uint32_t>(o.b.keys, expected.size());
    for (size_t k = 0; k < expected.size(); ++k)
        EXPECT_EQ((Word2{owners[k], parts[k]}), expected[k]);
}

void expectNothingLost(const Plate& plate, const FractureOptions& options, bool has_films) {
    const brittle::PreparedMesh solid = plate.solid();
    const DeviceEvent event(solid, options, Until::Emission);
    const Outcome outcome{event};
    EXPECT_EQ(!outcome.films.empty(), has_films);
    EXPECT_EQ(event[STATUS_DISSOLVED], 0u);
    for (const Word2& fate : outcome.fates)
        EXPECT_TRUE(fate[0] != FATE_FILM && fate[0] != FATE_DISSOLVED);
    expectMeasured(outcome);
    expectAtHome(outcome);
    expectPartsListed(outcome);
}

TEST(Films, OfImagesInTheFacesOfAPlateJoinThePiecesUnderThem) {
    expectNothingLost({.2, true}, Plate{.2, true}.mirrored(40), true);
    expectNothingLost({1e-2, true}, Plate{1e-2, true}.mirrored(40), true);
    expectNothingLost({1e-5, false}, Plate{1e-5, false}.mirrored(40), true);
}

// All of it is thinner than a film may be: pieces with something in them are fragments nevertheless.
TEST(Films, ThatAreAllThereIsAreFragments) {
    FractureOptions options{0, 0, {{-.3, 0, 0}, {.1, .2, 0}, {.2, -.4, 0}}};
    const Plate plate{1.5e-7, false};
    expectNothingLost(plate, options, true);
    const brittle::PreparedMesh solid = plate.solid();
    EXPECT_EQ(DeviceEvent(solid, options, Until::Emission)[COUNT_FRAGMENTS], 3u);
}

} // namespace
} // namespace kernel_test
