#include "tests/kernel/cap_polygons.h"

#include "modules/brittle/fracture/event.h"

#include <deque>
#include <map>
#include <numeric>
#include <random>

namespace kernel_test {
namespace {

// The buffers of the cap kernels, with all polygons one after the other.
struct CapBuffers {
    std::vector<uint32_t> offsets = {0}, first_point = {0};
    std::vector<Word4> segments;
    std::vector<std::array<int64_t, 3>> points;
    size_t faces() const { return offsets.size() - 1; }
};

// Segments come in any order, as atomics leave them; their sources say which order they had.
CapBuffers buffersOf(const std::vector<CapPolygon>& polygons, const CapBasis& basis) {
    CapBuffers all;
    std::mt19937 random(17);
    uint32_t source = 0;
    const auto flat = [](const CapPolygon& p, size_t s) { return s >= p.flat_from ? 1u : 0u; };
    for (const CapPolygon& polygon : polygons) {
        const uint32_t first = static_cast<uint32_t>(all.points.size());
        for (const CapPoint& p : polygon.points) {
            std::array<int64_t, 3> place;
            for (size_t k = 0; k < 3; ++k)
                place[k] = (int64_t{1} << 47) +
                           (int64_t{p[0]} * basis.x[k] + int64_t{p[1]} * basis.y[k]) * ((1 << 24) / polygon.per_step);
            all.points.push_back(place);
        }
        for (size_t s = 0; s < polygon.segments.size(); ++s)
            all.segments.push_back(
                {first + polygon.segments[s][0], first + polygon.segments[s][1], source++, flat(polygon, s)});
        std::shuffle(all.segments.begin() + all.offsets.back(), all.segments.end(), random);
        all.offsets.push_back(static_cast<uint32_t>(all.segments.size()));
        all.first_point.push_back(static_cast<uint32_t>(all.points.size()));
    }
    return all;
}

using Triangles = std::vector<Grid3>;

// As list_caps reads them: the first so many slots of a face that are filled, without triangles that name a corner twice.
std::vector<Grid3> trianglesOf(const CapBuffers& all, size_t f, uint32_t count, const std::vector<Grid3>& slots, size_t first,
                               uint32_t& collapsed) {
    std::vector<Grid3> triangles;
    const size_t end = std::min(first + 2 * (all.offsets[f + 1] - all.offsets[f]), slots.size());
    for (size_t at = first; at < end && triangles.size() < count; ++at) {
        if (slots[at][0] == -1) continue;
        Grid3 triangle;
        for (size_t k = 0; k < 3; ++k)
            triangle[k] = slots[at][k] - static_cast<int32_t>(all.first_point[f]);
        triangles.push_back(triangle);
    }
    EXPECT_EQ(triangles.size(), count) << "polygon " << f;
    const auto isCollapsed = [](const Grid3& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; };
    collapsed += static_cast<uint32_t>(std::erase_if(triangles, isCollapsed));
    return triangles;
}

// Views of the buffers that recordVastCaps reads and writes, with room for all sides.
class VastBuffers {
public:
    VastBuffers(uint32_t faces, uint32_t sides) {
        capacity.vast_sides = sides;
        capacity.vast_spans = 16 * sides;
        const size_t n = sides, halves = VAST_HALVES * n, tree = 2 * capacity.vastLeaves(), digits = (n / 64 + 1) * 16;
        take(views.vast_faces, 4ull * faces);
        for (engine::BufferView* quads : {&views.vast_ends, &views.vast_chords, &views.vast_rings, &views.vast_diagonals})
            take(*quads, 4 * n);
        take(views.vast_listed, 4 * n);
        for (engine::BufferView* words :
             {&views.vast_keys, &views.vast_values, &views.vast_other_keys, &views.vast_other_values, &views.vast_heads})
            take(*words, n);
        for (engine::BufferView* words : {&views.vast_histogram, &views.vast_digit_offsets})
            take(*words, digits + 1);
        for (engine::BufferView* words : {&views.vast_span_counts, &views.vast_span_offsets})
            take(*words, tree + 1);
        take(views.vast_spans, capacity.vast_spans);
        for (engine::BufferView* words : {&views.vast_links, &views.vast_marks, &views.vast_flags})
            take(*words, halves);
        for (engine::BufferView* pairs : {&views.vast_halves, &views.vast_labels, &views.vast_other_labels})
            take(*pairs, 2 * halves);
        take(views.vast_offsets, halves + 1);
        take(views.vast_caps, 3 * halves);
        take(views.sums, 4 * ((halves + tree + digits) / SCAN_BLOCK + 2));
    }

    // Every polygon as a vast face, whatever its size.
    void list(const CapBuffers& all, Counts& counts) {
        std::vector<Word4> faces;
        for (uint32_t f = 0; f < all.faces(); ++f)
            faces.push_back({f, all.offsets[f], all.offsets[f + 1] - all.offsets[f], 0});
        std::memcpy(buffers_.front().mapped(), faces.data(), sizeof(Word4) * faces.size());
        counts[COUNT_VAST_FACES] = counts[STATUS_BAD_CAP] = static_cast<uint32_t>(faces.size());
        counts[COUNT_VAST_SIDES] = all.offsets.back();
    }

    // The triangles of every face, which lie where the offsets step up.
    std::vector<Triangles> triangles(const CapBuffers& all, Counts& counts) const {
        std::vector<Triangles> found(all.faces());
        const Word4* faces = buffers_.front().mappedAs<Word4>();
        const uint32_t* offsets = mapped(views.vast_offsets);
        const uint32_t* caps = mapped(views.vast_caps);
        for (uint32_t j = 0; j < counts[COUNT_VAST_FACES]; ++j) {
            const auto& [face, first, count, unused] = faces[j];
            for (uint32_t h = VAST_HALVES * first; h < VAST_HALVES * (first + count); ++h)
                if (offsets[h + 1] != offsets[h]) found[face].push_back(triangleAt(caps + 3 * h, all.first_point[face]));
        }
        return found;
    }

    brittle::Capacities capacity;
    brittle::EventBuffers views;

private:
    void take(engine::BufferView& view, size_t words) {
        buffers_.push_back(blankBuffer<uint32_t>(std::max<size_t>(words, 4)));
        view = buffers_.back();
    }
    static const uint32_t* mapped(const engine::BufferView& view) { return view.buffer->mappedAs<uint32_t>(); }
    static Grid3 triangleAt(const uint32_t* corners, uint32_t first_point) {
        Grid3 triangle;
        for (size_t k = 0; k < 3; ++k)
            triangle[k] = static_cast<int32_t>(corners[k]) - static_cast<int32_t>(first_point);
        return triangle;
    }

    std::deque<engine::Buffer> buffers_; // views point to them
};

int64_t doubleArea(const CapPoint& a, const CapPoint& b, const CapPoint& c) {
    return int64_t{b[0] - a[0]} * (c[1] - a[1]) - int64_t{b[1] - a[1]} * (c[0] - a[0]);
}

// How often each side is walked one way more than the other.
class Outline {
public:
    void add(uint32_t a, uint32_t b) {
        if (a == b) return;
        int& net = net_[{std::min(a, b), std::max(a, b)}];
        net += a < b ? 1 : -1;
        if (net == 0) net_.erase({std::min(a, b), std::max(a, b)});
    }
    bool operator==(const Outline&) const = default;

private:
    std::map<Word2, int> net_;
};

} // namespace

const std::vector<CapBasis> kCapBases = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},   {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}},
                                         {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}},   {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}},
                                         {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},   {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                         {{1, -1, 0}, {1, 1, -2}, {1, 1, 1}}, {{1, 1, -2}, {1, -1, 0}, {-1, -1, -1}}};

CapPolygon polygonOf(const std::vector<CapLoop>& loops) {
    CapPolygon polygon;
    std::map<CapPoint, uint32_t> ids;
    int64_t triangles = 0;
    for (const CapLoop& loop : loops) {
        int64_t area = 0;
        for (size_t k = 0; k < loop.size(); ++k) {
            const CapPoint &a = loop[k], &b = loop[(k + 1) % loop.size()];
            for (const CapPoint& p : {a, b})
                if (ids.try_emplace(p, static_cast<uint32_t>(polygon.points.size())).second) polygon.points.push_back(p);
            polygon.segments.push_back({ids[a], ids[b]});
            area += doubleArea(loop[0], a, b);
        }
        triangles += static_cast<int64_t>(loop.size()) + (area > 0 ? -2 : 2);
    }
    polygon.triangles = static_cast<size_t>(triangles);
    return polygon;
}

CapRun capOnDevice(const std::vector<CapPolygon>& polygons, const CapBasis& basis, Through through) {
    const CapBuffers all = buffersOf(polygons, basis);
    const uint32_t n = static_cast<uint32_t>(polygons.size());
    const size_t slots = 2 * all.segments.size();
    Counts counts;
    counts[COUNT_FACES] = n;
    if (through == Through::Large) counts[COUNT_LARGE_FACES] = n;
    if (through == Through::Huge) counts[COUNT_HUGE_FACES] = n;
    const Grid3& to = basis.normal;
    const engine::Buffer sites = bufferOf<Int4>({{1000, 1000, 1000, 0}, {1000 + to[0], 1000 + to[1], 1000 + to[2], 0}});
    const engine::Buffer faces = bufferOf(countUp(n)), neighbors = bufferOf(std::vector<uint32_t>(n, 1));
    const engine::Buffer cells = bufferOf(std::vector<uint32_t>(n)), offsets = bufferOf(all.offsets),
                         points = bufferOf(all.points);
    const engine::Buffer segments = bufferOf(all.segments), welded = bufferOf(countUp(all.points.size()));
    counts[COUNT_SEGMENTS] = static_cast<uint32_t>(all.segments.size());
    std::vector<uint32_t> places; // where not all in turn, cap_faces has not found room for them
    for (size_t f = 0; f < n; ++f)
        places.push_back(counts[COUNT_SEGMENTS] + 2 * all.offsets[f]);
    const engine::Buffer loose = blankBuffer<Grid3>(all.segments.size() + slots), cap_counts = blankBuffer<uint32_t>(n),
                         cap_slots = bufferOf(places);
    const engine::Buffer wide = blankBuffer<uint32_t>(n), large = bufferOf(countUp(n)), huge = bufferOf(countUp(n));
    const engine::Buffer shared_points = bufferOf(std::vector<uint32_t>(all.points.size()));
    const engine::Buffer nodes = blankBuffer<Word4>(slots), rings = blankBuffer<Word4>(slots),
                         loops = blankBuffer<Word4>(slots);
    VastBuffers vast(n, all.offsets.back());
    if (through == Through::Vast) vast.list(all, counts);
    brittle::EventBuffers& views = vast.views;
    views.sites = sites, views.faces = faces, views.neighbors = neighbors, views.face_cells = cells;
    views.face_offsets = offsets, views.segments = segments, views.welded = welded, views.points = points;
    views.cap_counts = cap_counts;
    const auto run = [&](engine::Commands& commands, const char* name, uint32_t count, const engine::Buffer& list) {
        counts.publish(commands, count, n);
        commands.dispatchIndirect(kernel(name), counts.groupsOf(count), engine::NoPush{},
                                  {counts.words, sites, faces, neighbors, cells, offsets, segments, welded, points, loose,
                                   cap_counts, list, nodes, rings, loops, cap_slots});
    };
    onDevice([&](engine::Commands& commands) {
        if (through == Through::Convex) {
            commands.dispatch(kernel("cap_faces_convex"), n, engine::NoPush{},
                              {counts.words, faces, offsets, segments, welded, loose, cap_counts, wide, cap_slots});
            counts.publish(commands, COUNT_WIDE_FACES, n);
            commands.dispatchIndirect(kernel("cap_fans_convex"), counts.groupsOf(COUNT_WIDE_FACES), engine::NoPush{},
                                      {counts.words, faces, offsets, segments, welded, shared_points, loose, cap_counts, wide,
                                       cap_slots, views.vast_faces});
        }
        if (through == Through::AllInTurn) {
            commands.dispatch(kernel("cap_faces"), n, engine::NoPush{},
                              {counts.words, sites, faces, neighbors, cells, offsets, segments, welded, points, loose,
                               cap_counts, wide, cap_slots});
            counts.publish(commands, COUNT_WIDE_FACES, n);
            // No vertices of a mesh: as if all corners were on Voronoi edges.
            commands.dispatchIndirect(kernel("cap_fans"), counts.groupsOf(COUNT_WIDE_FACES), engine::NoPush{},
                                      {counts.words, sites, faces, neighbors, cells, offsets, segments, welded, points, loose,
                                       cap_counts, wide, large, huge, cap_slots, views.vast_faces});
        }
        if (through == Through::AllInTurn || through == Through::Vast || through == Through::Convex) {
            brittle::Recorder recorder(commands, kernels(), counts.words, counts.args);
            const brittle::EventGrid grid;
            brittle::recordVastCaps({.grid = grid, .capacity = vast.capacity, .b = views, .scene = {}, .record = recorder});
            const auto recorded = recorder.status();
            ASSERT_TRUE(recorded) << recorded.error().message;
        }
        if (through == Through::Vast || through == Through::Convex) return;
        if (through != Through::Huge) run(commands, "cap_faces_large", COUNT_LARGE_FACES, large);
        if (through != Through::Large) run(commands, "cap_faces_huge", COUNT_HUGE_FACES, huge);
    });
    CapRun result{{},
                  counts[COUNT_WIDE_FACES],
                  counts[COUNT_LARGE_FACES],
                  counts[COUNT_HUGE_FACES],
                  counts[COUNT_VAST_FACES],
                  counts[STATUS_BAD_CAP],
                  counts[STATUS_TURNED_OVER],
                  0};
    const std::vector<uint32_t> made = valuesOf<uint32_t>(cap_counts, n);
    const std::vector<Grid3> filled = valuesOf<Grid3>(loose, all.segments.size() + slots);
    std::vector<Triangles> of_vast = vast.triangles(all, counts);
    for (size_t f = 0; f < n; ++f)
        if (of_vast[f].empty())
            result.triangles.push_back(
                trianglesOf(all, f, made[f], filled, cap_slots.mappedAs<uint32_t>()[f], result.collapsed));
        else
            result.triangles.push_back(std::move(of_vast[f]));
    return result;
}

void expectTriangulated(const CapPolygon& polygon, const std::vector<Grid3>& triangles) {
    EXPECT_EQ(triangles.size(), polygon.triangles.value_or(triangles.size()));
    Outline expected, found;
    int64_t area = 0, sum = 0;
    for (const Word2& s : polygon.segments) {
        expected.add(s[0], s[1]);
        area += doubleArea({0, 0}, polygon.points[s[0]], polygon.points[s[1]]);
    }
    for (const Grid3& t : triangles) {
        std::array<CapPoint, 3> corner;
        for (size_t k = 0; k < 3; ++k) {
            const auto a = static_cast<size_t>(t[k]), b = static_cast<size_t>(t[(k + 1) % 3]);
            ASSERT_LT(std::max(a, b), polygon.points.size());
            found.add(static_cast<uint32_t>(a), static_cast<uint32_t>(b));
            corner[k] = polygon.points[a];
        }
        const int64_t part = doubleArea(corner[0], corner[1], corner[2]);
        int64_t reach = 0;
        for (size_t k = 0; k < 3; ++k)
            for (size_t axis = 0; axis < 2; ++axis)
                reach += std::abs(corner[k][axis] - corner[(k + 1) % 3][axis]);
        EXPECT_GE(part, polygon.crosses > 0   ? -polygon.crosses * reach
                        : polygon.may_be_flat ? 0
                                              : 1)
            << t[0] << " " << t[1] << " " << t[2];
        sum += part;
    }
    EXPECT_EQ(sum, area);
    EXPECT_TRUE(found == expected) << "the outline of " << polygon.segments.size() << " sides is not that of the triangles";
}

} // namespace kernel_test
