// place_sites, weld_sites, flag_sites, keep_sites, bin_sites and order_bins: sites drawn in a solid, sites given more than
// once, and the search grid that all later stages look into.
#include "tests/kernel/device_event.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <map>
#include <random>
#include <set>

namespace kernel_test {
namespace {

using brittle::Double3;
using brittle::FractureOptions;
using brittle::PreparedMesh;
using reference::GridPoint;

constexpr uint32_t kCounts[] = {1, 63, 64, 65, FEW_SITES, FEW_SITES + 1}; // few are sorted by one workgroup

std::vector<GridPoint> placedIn(const PreparedMesh& solid, uint32_t count, uint64_t seed) {
    const DeviceEvent event(solid, {count, seed, {}}, Until::Sites);
    EXPECT_EQ(event[COUNT_SITES] + event[STATUS_WELDED], count);
    return event.sites();
}

void expectInside(const PreparedMesh& solid, uint32_t count) {
    const DeviceEvent event(solid, {count, 11, {}}, Until::Sites);
    const reference::Triangles triangles = event.triangles();
    const std::vector<GridPoint> sites = event.sites();
    ASSERT_EQ(sites.size(), count);
    for (const GridPoint& s : sites)
        ASSERT_GT(reference::windingNumber(triangles, {double(s[0]), double(s[1]), double(s[2])}), 0.5)
            << s[0] << " " << s[1] << " " << s[2];
}

TEST(SmallSites, ArePlacedInsideASolidThatIsNotConvex) {
    const PreparedMesh bumpy = solidOf("bumpy:2");
    for (const uint32_t count : {1u, 63u, 64u, 65u})
        expectInside(bumpy, count);
}

TEST(Sites, ArePlacedInsideARingAndNotInItsHole) { expectInside(solidOf("ring"), 300); }

TEST(Sites, ArePlacedInAShellAndNotInItsCavity) {
    const auto outside = support::boxTriangles({0, 0, 0}, {10, 10, 10});
    const auto cavity = support::turnedOver(support::boxTriangles({1, 1, 1}, {9, 9, 9}));
    expectInside(solidOf(support::joined(outside, cavity)), 1234);
}

TEST(SmallSites, FollowFromTheSeedAlone) {
    const PreparedMesh cube = solidOf("cube");
    const std::vector<GridPoint> sites = placedIn(cube, 200, 5);
    EXPECT_EQ(placedIn(cube, 200, 5), sites);
    EXPECT_NE(placedIn(cube, 200, 6), sites);
    EXPECT_NE(placedIn(cube, 200, 5 + (uint64_t{1} << 32)), sites);
}

// Each octant of a cube holds an eighth of the sites, but for chance: five standard deviations.
TEST(Sites, AreSpreadEvenly) {
    constexpr uint32_t kCount = 8000;
    std::array<uint32_t, 8> octants = {};
    for (const GridPoint& s : placedIn(solidOf("cube"), kCount, 3))
        ++octants[(s[0] >> 23 & 1) + 2u * (s[1] >> 23 & 1) + 4u * (s[2] >> 23 & 1)];
    for (const uint32_t in_octant : octants)
        EXPECT_NEAR(in_octant, kCount / 8.0, 5 * 29.6);
}

// On a coarse lattice, so that many fall together.
FractureOptions crowdedSites(uint32_t count) {
    std::mt19937 random(count);
    FractureOptions options;
    const int steps = std::max(2, static_cast<int>(count) / 12);
    for (uint32_t s = 0; s < count; ++s) {
        Double3 p;
        for (double& x : p)
            x = static_cast<double>(random() % static_cast<uint32_t>(steps % 11 + 2)) / 16 - .25;
        options.given_sites.push_back(p);
    }
    return options;
}

TEST(SmallSites, AtOnePlaceAreWeldedToTheFirst) {
    for (const uint32_t count : kCounts) {
        const FractureOptions options = crowdedSites(count);
        const DeviceEvent event(solidOf("cube"), options, Until::Sites);
        std::set<Double3> seen;
        std::vector<Int4> expected;
        for (uint32_t s = 0; s < count; ++s) {
            const Double3& p = options.given_sites[s];
            const auto at = [&](size_t k) { return (1 << 23) + static_cast<int32_t>(p[k] * double(event.grid().scale)); };
            if (seen.insert(p).second) expected.push_back({at(0), at(1), at(2), static_cast<int32_t>(s)});
        }
        EXPECT_EQ(event[COUNT_SITES], expected.size());
        EXPECT_EQ(event[STATUS_WELDED], count - expected.size());
        EXPECT_EQ(event.read<Int4>(event.buffers().sites, event[COUNT_SITES]), expected);
    }
}

// Weld points until the table is full of each place's highest point, as if that had come first, and then weld them again.
TEST(SmallSites, AtOnePlaceAreWeldedToTheFirstWhicheverComesFirst) {
    for (const uint32_t count : kSizes) {
        std::vector<std::array<uint32_t, 3>> points;
        std::map<std::array<uint32_t, 3>, std::array<uint32_t, 2>> ends; // lowest and highest id at a place
        std::vector<uint32_t> expected;
        for (uint32_t s = 0; s < count; ++s) {
            points.push_back({s * s % 37, s % 5, s * 7 % 3});
            ends.try_emplace(points[s], std::array<uint32_t, 2>{s, s}).first->second[1] = s;
            expected.push_back(ends[points[s]][0]);
        }
        Counts counts;
        const engine::Buffer in = bufferOf(points), table = bufferOf(std::vector<uint32_t>(4096));
        const engine::Buffer slots = blankBuffer<uint32_t>(count), welded = blankBuffer<uint32_t>(count);
        const engine::Buffer shared = blankBuffer<uint32_t>(count);
        const auto weld = [&](engine::Commands& commands) {
            commands.dispatch(kernel("weld_sites"), count, std::array<uint32_t, 3>{count, NO_INDEX, 4095},
                              {counts.words, in, table, slots});
            commands.dispatch(kernel("resolve_points"), count, Word2{count, NO_INDEX},
                              {counts.words, table, slots, welded, shared});
        };
        onDevice(weld);
        EXPECT_EQ(valuesOf<uint32_t>(welded, count), expected);
        for (uint32_t& held : std::span(table.mappedAs<uint32_t>(), 4096))
            if (held != 0) held = ends[points[held - 1]][1] + 1;
        onDevice(weld);
        EXPECT_EQ(valuesOf<uint32_t>(welded, count), expected);
        EXPECT_EQ(counts[STATUS_BAD_WELD], 0u);
    }
}

TEST(SmallSites, WithoutAPlaceAreCountedAndLeftOut) {
    for (const uint32_t count : kSizes) {
        std::vector<uint32_t> welded, placed, expected;
        for (uint32_t s = 0; s < count; ++s) {
            welded.push_back(s % 7 == 3 ? s - 1 : s);
            placed.push_back(s % 5 == 4 ? 0 : 1);
            expected.push_back(s % 7 != 3 && s % 5 != 4 ? 1 : 0);
        }
        Counts counts;
        counts[COUNT_ASKED_SITES] = count;
        const engine::Buffer in = bufferOf(welded), here = bufferOf(placed), flags = blankBuffer<uint32_t>(count);
        onDevice([&](engine::Commands& commands) {
            commands.dispatch(kernel("flag_sites"), count, engine::NoPush{}, {counts.words, in, here, flags});
        });
        EXPECT_EQ(valuesOf<uint32_t>(flags, count), expected);
        EXPECT_EQ(counts[STATUS_UNPLACED], count / 5);
        EXPECT_EQ(counts[STATUS_UNPLACED] + counts[STATUS_WELDED], std::count(expected.begin(), expected.end(), 0u));
    }
}

// By hand: the bin of a site, and the sites of each bin in the order of their ids.
std::map<uint32_t, std::vector<uint32_t>> binsOf(const DeviceEvent& event, const std::vector<GridPoint>& sites) {
    const brittle::EventGrid& grid = event.grid();
    std::map<uint32_t, std::vector<uint32_t>> bins;
    for (uint32_t s = 0; s < sites.size(); ++s) {
        uint32_t bin = 0;
        for (size_t k = 3; k-- > 0;)
            bin = bin * static_cast<uint32_t>(grid.bins[k]) +
                  static_cast<uint32_t>((sites[s][k] - grid.box_low[k]) / grid.bins[3]);
        bins[bin].push_back(s);
    }
    return bins;
}

void expectBinned(const DeviceEvent& event) {
    const std::vector<GridPoint> sites = event.sites();
    const uint32_t bin_count = event.grid().binCount();
    const std::vector<uint32_t> start = event.read<uint32_t>(event.buffers().bin_start, bin_count + 1);
    const std::vector<Int4> binned = event.read<Int4>(event.buffers().bin_sites, sites.size());
    auto bins = binsOf(event, sites);
    uint32_t at = 0;
    for (uint32_t bin = 0; bin < bin_count; ++bin) {
        ASSERT_EQ(start[bin], at) << "bin " << bin;
        for (const uint32_t s : bins[bin]) {
            const Int4 expected = {sites[s][0], sites[s][1], sites[s][2], static_cast<int32_t>(s)};
            ASSERT_EQ(binned[at++], expected) << "bin " << bin;
        }
    }
    EXPECT_EQ(start[bin_count], sites.size());
}

TEST(SmallSites, LieOnceEachInTheirBinsByIds) {
    for (const uint32_t count : kCounts) {
        expectBinned(DeviceEvent(solidOf("cube"), crowdedSites(count), Until::Sites));
        expectBinned(DeviceEvent(solidOf("cube"), {count, 2, {}}, Until::Sites));
    }
}

TEST(Sites, OfALargeEventLieInTheirBins) { expectBinned(DeviceEvent(solidOf("bumpy:2"), {50'000, 2, {}}, Until::Sites)); }

// All in one bin: its order is the whole sort.
TEST(Sites, OfOneBinAreOrderedById) {
    FractureOptions options;
    std::mt19937 random(1);
    const auto draw = [&] { return static_cast<double>(random() % 4096) * 0x1p-19; };
    for (uint32_t s = 0; s < 3000; ++s)
        options.given_sites.push_back({draw(), draw(), draw()});
    options.given_sites.push_back({100, 100, 100});
    expectBinned(DeviceEvent(solidOf("cube"), options, Until::Sites));
}

TEST(SmallSites, StandOnAGridToWhichTheMeshIsSnapped) {
    const DeviceEvent event(solidOf("bumpy:2"), {1, 1, {}}, Until::Sites);
    std::vector<GridPoint> snapped;
    for (const Int4& v : event.read<Int4>(event.buffers().grid_vertices, event.vertexCount()))
        snapped.push_back({v[0], v[1], v[2]});
    EXPECT_EQ(snapped, event.vertices());
}

} // namespace
} // namespace kernel_test
