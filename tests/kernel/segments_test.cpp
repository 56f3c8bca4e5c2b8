// cap_intervals, cap_cuts, flag_faces and what cap_faces makes of their segments in whole events: the boundary of the solid's
// part in every bisector is closed, and the cap has this boundary and no other.
#include "tests/kernel/device_event.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <map>
#include <random>
#include <set>

namespace kernel_test {
namespace {

using brittle::FractureOptions;

struct Faces {
    const DeviceEvent& event;
    uint32_t entries = event[COUNT_NEIGHBORS];
    std::vector<uint32_t> offsets = event.read<uint32_t>(event.buffers().face_offsets, entries + 1);
    std::vector<Word4> segments = event.read<Word4>(event.buffers().segments, event[COUNT_SEGMENTS]);
    std::vector<uint32_t> welded = event.read<uint32_t>(event.buffers().welded, event[COUNT_POINTS]);
    std::vector<uint32_t> faces = event.read<uint32_t>(event.buffers().faces, event[COUNT_FACES]);
    std::vector<uint32_t> cap_counts = event.read<uint32_t>(event.buffers().cap_counts, event[COUNT_FACES]);
    std::vector<uint32_t> slots = event.read<uint32_t>(event.buffers().cap_slots, event[COUNT_FACES]);
    std::vector<std::array<uint32_t, 3>> caps =
        event.read<std::array<uint32_t, 3>>(event.buffers().loose_caps, segments.size() + event[COUNT_NODES]);
};

// How often each side is walked one way more than the other; the lower end first.
using Outline = std::map<Word2, int>;
void walk(Outline& outline, uint32_t a, uint32_t b) {
    if (a == b) return;
    const Word2 side = {std::min(a, b), std::max(a, b)};
    if ((outline[side] += a < b ? 1 : -1) == 0) outline.erase(side);
}

Outline outlineOf(const Faces& f, uint32_t face) {
    Outline outline;
    for (uint32_t k = f.offsets[face]; k < f.offsets[face + 1]; ++k)
        walk(outline, f.welded[f.segments[k][0]], f.welded[f.segments[k][1]]);
    return outline;
}

void expectClosed(const Outline& outline, uint32_t face) {
    std::map<uint32_t, int> balance;
    for (const auto& [side, net] : outline) {
        balance[side[0]] += net;
        balance[side[1]] -= net;
    }
    for (const auto& [point, net] : balance)
        ASSERT_EQ(net, 0) << "point " << point << " of face " << face;
}

// Corners of caps are welded points already.
Outline capOutline(const Faces& f, size_t at) {
    Outline outline;
    uint32_t left = f.cap_counts[at];
    for (uint32_t slot = f.slots[at]; slot < f.caps.size() && left > 0; ++slot) {
        const std::array<uint32_t, 3>& cap = f.caps[slot];
        if (cap[0] == NO_INDEX) continue;
        --left;
        for (size_t k = 0; k < 3; ++k)
            walk(outline, cap[k], cap[(k + 1) % 3]);
    }
    EXPECT_EQ(left, 0u);
    return outline;
}

// Only the lower cell's entry carries a cap, and it does where it has segments.
void expectListed(const Faces& f) {
    const auto cells = f.event.read<uint32_t>(f.event.buffers().face_cells, f.entries);
    const auto neighbors = f.event.read<uint32_t>(f.event.buffers().neighbors, f.entries);
    std::vector<uint32_t> expected;
    for (uint32_t face = 0; face < f.entries; ++face) {
        if (f.offsets[face] == f.offsets[face + 1]) continue;
        expected.push_back(face);
        ASSERT_LT(cells[face], neighbors[face]);
    }
    EXPECT_EQ(f.faces, expected);
}

// By the source a segment says where it came from; chains are ordered by it, and so it must be its own.
void expectOwnSources(const Faces& f) {
    for (const uint32_t face : f.faces) {
        std::set<uint32_t> sources;
        for (uint32_t k = f.offsets[face]; k < f.offsets[face + 1]; ++k)
            ASSERT_TRUE(sources.insert(f.segments[k][2]).second) << "face " << face;
    }
}

void expectCaps(const brittle::PreparedMesh& solid, const FractureOptions& options) {
    SCOPED_TRACE(options.given_sites.empty() ? options.site_count : options.given_sites.size());
    const DeviceEvent event(solid, options, Until::Caps);
    if (event[COUNT_NEIGHBORS] == 0) return;
    const Faces f{event};
    ASSERT_EQ(f.offsets[f.entries], f.segments.size());
    expectListed(f);
    expectOwnSources(f);
    for (size_t at = 0; at < f.faces.size(); ++at) {
        const Outline outline = outlineOf(f, f.faces[at]);
        expectClosed(outline, f.faces[at]);
        ASSERT_TRUE(capOutline(f, at) == outline) << "face " << f.faces[at];
    }
}

TEST(SmallSegments, BoundTheCapsOfEveryFace) {
    const brittle::PreparedMesh bumpy = solidOf("bumpy:1");
    for (const uint32_t count : {1u, 2u, 63u, 64u, 65u})
        expectCaps(bumpy, {count, count, {}});
}

TEST(Segments, OfManyFaces) { expectCaps(solidOf("bumpy:2"), {1234, 5, {}}); }
TEST(Segments, OfLoopsInARing) { expectCaps(solidOf("ring"), {40, 2, {}}); }

TEST(Segments, OfShellsWithinShells) {
    reference::Triangles shells;
    for (int k = 0; k < 4; ++k) {
        const double r = 10 - 2 * k;
        const reference::Triangles box = support::boxTriangles({-r, -r, -r}, {r, r, r});
        shells = support::joined(shells, k % 2 == 0 ? box : support::turnedOver(box));
    }
    const FractureOptions halves{0, 0, {{-4.3, .1, .2}, {4.1, .3, -.1}}};
    expectCaps(solidOf(shells), halves);
    expectCaps(solidOf(shells), {100, 2, {}});
}

// Bisectors along the faces of the cube, and cells that meet in lattice points.
TEST(SmallSegments, OfALattice) {
    for (const double apart : {.25, .5}) {
        FractureOptions options = latticeSites(apart);
        for (uint32_t seed = 0; seed < 4; ++seed) {
            std::shuffle(options.given_sites.begin(), options.given_sites.end(), std::mt19937(seed));
            expectCaps(solidOf("cube"), options);
        }
    }
}

} // namespace
} // namespace kernel_test
