// classify_pieces, allocate, emit and emit_objects: the ranges of the fragments in the scene's pools are dense and apart, and
// every triangle that is left lies there once, on the right side.
#include "tests/kernel/device_event.h"
#include "tests/support/shapes.h"

#include "shaders-spirv/shared/fragment_record.h"
#include "shaders-spirv/shared/scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace kernel_test {
namespace {

using brittle::FractureOptions;
using brittle::FragmentRecord;
using brittle::FragmentVertex;
using Corners = std::array<std::array<float, 3>, 3>;
using Word3 = std::array<uint32_t, 3>;

struct Demand {
    std::vector<Word3> sizes; // triangles of every component: own surface, faces of earlier cuts, inner
    std::vector<Word2> fates;
};

// A third of the components are cavities, of any fragment, before it or after it.
Demand randomDemand(uint32_t count) {
    std::mt19937 random(count);
    const auto below = [&](uint32_t n) { return static_cast<uint32_t>(random() % n); };
    Demand demand;
    std::vector<uint32_t> fragments;
    for (uint32_t c = 0; c < count; ++c) {
        demand.sizes.push_back({below(5), below(4), below(5) + 1});
        demand.fates.push_back({c % 7 == 3 ? FATE_DISSOLVED : FATE_FRAGMENT, c});
        if (c % 7 == 3) demand.sizes[c] = {0, 0, 0};
        if (c % 7 != 3 && c % 3 != 1) fragments.push_back(c);
    }
    for (uint32_t c = 0; c < count; ++c)
        if (c % 7 != 3 && c % 3 == 1)
            demand.fates[c] = {FATE_CAVITY, fragments[below(static_cast<uint32_t>(fragments.size()))]};
    return demand;
}

void expectAllocated(const Demand& demand) {
    const uint32_t n = static_cast<uint32_t>(demand.sizes.size());
    Counts counts;
    counts[COUNT_COMPONENTS] = n;
    std::vector<uint32_t> start = {0}, hollow;
    std::vector<Word4> class_offsets = {{0, 0, 0, 0}}, demands, shares;
    std::vector<Word3> totals(n, Word3{0, 0, 0});
    for (uint32_t c = 0; c < n; ++c) {
        start.push_back(start.back());
        for (size_t side = 0; side < 3; ++side) {
            start.back() += demand.sizes[c][side];
            for (uint32_t k = 0; k < demand.sizes[c][side]; ++k) {
                class_offsets.push_back(class_offsets.back());
                ++class_offsets.back()[side];
            }
        }
        if (demand.fates[c][0] == FATE_CAVITY) hollow.push_back(c);
    }
    // Of a fragment the piece itself comes first, then its cavities by number.
    for (const bool cavities : {false, true})
        for (uint32_t c = 0; c < n; ++c) {
            if ((demand.fates[c][0] == FATE_CAVITY) != cavities) continue;
            Word3& total = totals[demand.fates[c][1]];
            shares.resize(2 * size_t{n});
            shares[2 * c] = {total[0], total[1], total[2], 0};
            for (size_t side = 0; side < 3; ++side)
                total[side] += demand.sizes[c][side];
        }
    for (uint32_t c = 0; c < n; ++c) {
        const auto [fate, owner] = demand.fates[c];
        const Word3& total = totals[owner];
        shares[2 * c + 1] = {total[0], total[1], total[2], 0};
        demands.push_back(fate == FATE_FRAGMENT ? Word4{1, total[0] + total[1] + total[2], 0, 0} : Word4{0, 0, 0, 0});
    }
    counts[COUNT_PARTS] = static_cast<uint32_t>(hollow.size());
    const auto owner = [&](uint32_t c) { return demand.fates[c][1]; };
    std::stable_sort(hollow.begin(), hollow.end(), [&](uint32_t a, uint32_t b) { return owner(a) < owner(b); });
    std::vector<uint32_t> part_owners;
    part_owners.reserve(hollow.size());
    for (const uint32_t c : hollow)
        part_owners.push_back(owner(c));
    const engine::Buffer hollows = bufferOf(hollow), owners = bufferOf(part_owners), first = bufferOf(start),
                         classes = bufferOf(class_offsets), fates = bufferOf(demand.fates);
    const engine::Buffer asked = blankBuffer<Word4>(n), share = blankBuffer<Word4>(2 * size_t{n});
    onDevice([&](engine::Commands& commands) {
        commands.dispatch(kernel("allocate"), n, engine::NoPush{},
                          {counts.words, first, classes, fates, asked, share, hollows, owners});
    });
    EXPECT_EQ(valuesOf<Word4>(asked, n), demands);
    EXPECT_EQ(valuesOf<Word4>(share, 2 * size_t{n}), shares);
}

TEST(SmallAllocation, GivesFragmentsRoomForTheirCavities) {
    for (const uint32_t count : kSizes)
        expectAllocated(randomDemand(count));
}

TEST(SmallAllocation, WithoutCavitiesIsByComponents) {
    Demand demand = randomDemand(200);
    for (uint32_t c = 0; c < 200; ++c)
        demand.fates[c] = {c % 7 == 3 ? FATE_DISSOLVED : FATE_FRAGMENT, c};
    expectAllocated(demand);
}

struct Emitted {
    const DeviceEvent& event;
    const brittle::EventBuffers& b = event.buffers();
    uint32_t count = event[COUNT_FRAGMENTS], triangles = event[COUNT_EMITTED];
    std::vector<FragmentRecord> fragments = event.read<FragmentRecord>(event.scene().fragments, count);
    std::vector<FragmentVertex> vertices = event.read<FragmentVertex>(event.scene().vertices, 3 * triangles);
    std::vector<uint32_t> indices = event.read<uint32_t>(event.scene().indices, 3 * triangles);
    uint32_t first(uint32_t f) const { return fragments[f].range[1]; }
    uint32_t outer(uint32_t f) const { return fragments[f].range[2]; }
    uint32_t earlier(uint32_t f) const { return fragments[f].fate[3]; } // of the outer ones, the last
    uint32_t size(uint32_t f) const { return outer(f) + fragments[f].range[3]; }
    Corners triangle(uint32_t t) const {
        Corners corners;
        for (size_t k = 0; k < 3; ++k)
            std::copy_n(vertices[3 * t + k].position, 3, corners[k].begin());
        return corners;
    }
};

// Fragment after fragment, and in each of them every vertex is named once.
void expectDense(const Emitted& e) {
    uint32_t at = 0;
    for (uint32_t f = 0; f < e.count; ++f) {
        ASSERT_EQ(e.fragments[f].range[0], f);
        ASSERT_EQ(e.first(f), at);
        ASSERT_GT(e.size(f), 0u);
        for (uint32_t k = 0; k < 3 * e.size(f); ++k)
            ASSERT_EQ(e.indices[3 * at + k], k) << "fragment " << f;
        at += e.size(f);
    }
    EXPECT_EQ(at, e.triangles);
}

// By hand, of every fragment: its triangles by their corners.
struct Sides {
    std::vector<Corners> own, earlier, inner;
};

std::map<uint32_t, Sides> sidesOf(const DeviceEvent& event) {
    const brittle::EventBuffers& b = event.buffers();
    const uint32_t n = event[COUNT_TRIANGLES], caps = event.triangleCount() + event[COUNT_FAN_TRIANGLES];
    const auto pieces = event.read<Word4>(b.pieces, n);
    const auto components = event.read<uint32_t>(b.components, n), sources = event.read<uint32_t>(b.sources, n);
    const auto fates = event.read<Word2>(b.fates, event[COUNT_COMPONENTS]);
    const auto positions = event.read<std::array<float, 4>>(b.positions, event[COUNT_POINTS]);
    const auto stays = [&](uint32_t t) { return components[t] != NO_INDEX && fates[components[t]][0] != FATE_DISSOLVED; };
    std::map<uint32_t, Sides> sides;
    for (uint32_t t = 0; t < n; ++t) {
        if (!stays(t)) continue;
        Corners corners;
        for (size_t k = 0; k < 3; ++k)
            std::copy_n(positions[pieces[t][k]].begin(), 3, corners[k].begin());
        Sides& side = sides[fates[components[t]][1]];
        const bool faced = t >= caps && stays(caps + ((t - caps) ^ 1));
        const bool earlier = t < caps && sources[t] >= event.mesh().own_triangles;
        (faced ? side.inner : earlier ? side.earlier : side.own).push_back(corners);
    }
    return sides;
}

void expectEveryTriangleOnce(const Emitted& e) {
    std::map<uint32_t, Sides> sides = sidesOf(e.event);
    ASSERT_EQ(sides.size(), e.count);
    for (uint32_t f = 0; f < e.count; ++f) {
        Sides& expected = sides[e.fragments[f].fate[1]];
        Sides found;
        for (uint32_t k = 0; k < e.size(f); ++k)
            (k >= e.outer(f)                  ? found.inner
             : k >= e.outer(f) - e.earlier(f) ? found.earlier
                                              : found.own)
                .push_back(e.triangle(e.first(f) + k));
        for (Sides* sides_of : {&expected, &found})
            for (std::vector<Corners>* list : {&sides_of->own, &sides_of->earlier, &sides_of->inner})
                std::sort(list->begin(), list->end());
        ASSERT_TRUE(found.own == expected.own) << "fragment " << f;
        ASSERT_TRUE(found.earlier == expected.earlier) << "fragment " << f;
        ASSERT_TRUE(found.inner == expected.inner) << "fragment " << f;
    }
}

void expectDrawn(const Emitted& e) {
    const auto commands = e.event.read<gpu::DrawCommand>(e.event.scene().draw_commands, 2 * e.count);
    const auto bounds = e.event.read<gpu::Bounds>(e.event.scene().bounds, e.count);
    for (uint32_t f = 0; f < e.count; ++f) {
        const std::array<uint32_t, 2> sizes = {e.outer(f) - e.earlier(f), e.fragments[f].range[3] + e.earlier(f)};
        for (uint32_t side = 0; side < 2; ++side) {
            const gpu::DrawCommand& command = commands[2 * f + side];
            ASSERT_EQ(command.index_count, 3 * sizes[side]);
            ASSERT_EQ(command.instance_count, sizes[side] > 0 ? 1u : 0u);
            ASSERT_EQ(command.first_index, 3 * (e.first(f) + (side == 1 ? sizes[0] : 0)));
            ASSERT_EQ(command.vertex_offset, static_cast<int32_t>(3 * e.first(f)));
            ASSERT_EQ(command.first_instance, 2 * f + side);
        }
        for (size_t k = 0; k < 3; ++k) {
            ASSERT_EQ(bounds[f].lower[k] * e.event.grid().unit(), e.fragments[f].low[k]);
            ASSERT_EQ(bounds[f].upper[k] * e.event.grid().unit(), e.fragments[f].high[k]);
        }
    }
}

// Unit length everywhere; on the inside that of the triangle.
void expectNormals(const Emitted& e) {
    for (uint32_t f = 0; f < e.count; ++f)
        for (uint32_t t = e.first(f); t < e.first(f) + e.size(f); ++t) {
            reference::Point p[3], n;
            for (size_t k = 0; k < 9; ++k)
                p[k / 3][k % 3] = static_cast<double>(e.triangle(t)[k / 3][k % 3]);
            n = reference::cross(reference::operator-(p[1], p[0]), reference::operator-(p[2], p[0]));
            const double twice = reference::length(n);
            for (size_t k = 0; k < 3; ++k) {
                const float* normal = e.vertices[3 * t + k].normal;
                const reference::Point m = {double(normal[0]), double(normal[1]), double(normal[2])};
                ASSERT_NEAR(reference::length(m), 1, 1e-4);
                if (t >= e.first(f) + e.outer(f) && twice > 1e-4) {
                    ASSERT_NEAR(reference::dot(m, n) / twice, 1, 1e-3);
                }
            }
        }
}

void expectEmitted(const brittle::PreparedMesh& solid, const FractureOptions& options) {
    SCOPED_TRACE(options.given_sites.empty() ? options.site_count : options.given_sites.size());
    const DeviceEvent event(solid, options, Until::Emission);
    const Emitted emitted{event};
    expectDense(emitted);
    expectEveryTriangleOnce(emitted);
    expectDrawn(emitted);
    expectNormals(emitted);
}

TEST(SmallEmission, OfEveryTriangleOnce) {
    const brittle::PreparedMesh bumpy = solidOf("bumpy:1");
    for (const uint32_t count : {1u, 2u, 63u, 64u, 65u})
        expectEmitted(bumpy, {count, count, {}});
}

TEST(SmallEmission, DrawsFacesOfEarlierCutsAsInnerOnes) {
    brittle::PreparedMesh bumpy = solidOf("bumpy:1");
    for (const uint32_t own : {0u, 1u, 40u, 79u}) {
        bumpy.mesh.own_triangles = own;
        expectEmitted(bumpy, {.site_count = 20, .seed = 3});
    }
}

TEST(Emission, OfManyFragments) { expectEmitted(solidOf("bumpy:2"), {.site_count = 1234, .seed = 5}); }
TEST(Emission, OfARing) { expectEmitted(solidOf("ring"), {.site_count = 60, .seed = 5}); }

// One cell that holds a shell, and a box in its hollow with a hollow of its own: two fragments with a cavity each.
TEST(SmallEmission, PutsCavitiesToTheirFragments) {
    reference::Triangles shells;
    for (int k = 0; k < 4; ++k) {
        const double r = 10 - 2 * k;
        const reference::Triangles box = support::boxTriangles({-r, -r, -r}, {r, r, r});
        shells = support::joined(shells, k % 2 == 0 ? box : support::turnedOver(box));
    }
    const FractureOptions one{0, 0, {{9, 9, 9}}};
    expectEmitted(solidOf(shells), one);
    const DeviceEvent event(solidOf(shells), one, Until::Emission);
    const Emitted emitted{event};
    ASSERT_EQ(emitted.count, 2u);
    EXPECT_EQ(event[COUNT_CAVITIES], 2u);
    EXPECT_EQ(emitted.size(0), 24u);
    EXPECT_EQ(emitted.size(1), 24u);
    expectEmitted(solidOf(shells), {.site_count = 100, .seed = 4});
}

} // namespace
} // namespace kernel_test
