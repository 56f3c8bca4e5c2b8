// Sites: placed in the mesh or given, welded where they fall together, and sorted into the bins of the search grid.
#include "modules/brittle/fracture/event.h"
#include "modules/brittle/mesh/vector_math.h"

#include <algorithm>
#include <cmath>

namespace brittle {
namespace {

// Of the pattern that was asked for, then evenly for sites that it found no place for.
constexpr uint32_t kPatternRounds = 2, kEvenRounds = 4;

struct PlacePush {
    Int4 low, high, impact;
    uint32_t site_count, occupied, seed_low, seed_high, first_try, triangle_count, favor, furthest, tallest, candidates;
};

double furthestPlace(const EventGrid& g, const Int3& from) {
    double square = 0;
    for (size_t k = 0; k < 3; k++)
        square += std::pow(std::max(std::abs(g.mesh_low[k] - from[k]), std::abs(g.mesh_high[k] - from[k])), 2.0);
    return std::ceil(std::sqrt(square)) + 1;
}

PlacePush placePush(const Event& e, const Placement& from) {
    const EventGrid& g = e.grid;
    const Impact& impact = from.options.impact;
    const bool has_impact = from.options.pattern != Pattern::Uniform; // of an even one whatever place is told may lie anywhere
    const Int3 place = snapToGrid(g, has_impact ? impact.place - from.mesh.center : Double3{});
    const double furthest = furthestPlace(g, place);
    const double radius = std::clamp(impact.contact_radius * static_cast<double>(g.scale), 1.0, furthest);
    return {withLast(g.mesh_low, from.columns.edge),
            withLast(g.mesh_high, from.columns.per_row),
            withLast(place, static_cast<int32_t>(radius)),
            e.capacity.sites,
            static_cast<uint32_t>(from.columns.occupied.size()),
            static_cast<uint32_t>(from.options.seed),
            static_cast<uint32_t>(from.options.seed >> 32),
            0,
            e.capacity.triangles,
            static_cast<uint32_t>(std::clamp(impact.favor, 0.0, 1.0) * 4294967295.0),
            static_cast<uint32_t>(furthest),
            from.columns.tallest,
            impact.candidates};
}

void recordPatternRound(const Event& e, Pattern pattern, const PlacePush& push) {
    const auto& b = e.b;
    const uint32_t sites = e.capacity.sites;
    const uint32_t in_group = PAPER_LANES / push.candidates;
    if (pattern == Pattern::Paper)
        e.record.runGroups(
            "place_sites_paper", (sites + in_group - 1) / in_group, push,
            {e.record.counts(), b.grid_vertices, b.mesh_triangles, b.column_start, b.column_triangles, b.raw_sites, b.placed});
    else
        e.record.run("place_sites_impact", Length::of(sites), push,
                     {e.record.counts(), b.grid_vertices, b.mesh_triangles, b.column_start, b.column_triangles, b.columns,
                      b.raw_sites, b.placed});
}

void recordPatterns(const Event& e, const Placement& from) {
    PlacePush push = placePush(e, from);
    if (from.options.pattern != Pattern::Uniform)
        for (uint32_t round = 0; round < kPatternRounds; round++, push.first_try += TRIES_A_ROUND)
            recordPatternRound(e, from.options.pattern, push);
    for (uint32_t round = 0; round < kEvenRounds; round++, push.first_try += TRIES_A_ROUND)
        e.record.run("place_sites", Length::of(e.capacity.sites), push,
                     {e.record.counts(), e.b.grid_vertices, e.b.mesh_triangles, e.b.column_start, e.b.column_triangles,
                      e.b.columns, e.b.raw_sites, e.b.placed});
}

void recordSiteWelding(const Event& e) {
    const uint32_t n = e.capacity.sites;
    const Length asked = Length::counted(COUNT_ASKED_SITES, n);
    struct WeldPush {
        uint32_t length, length_count, table_mask;
    } weld = {0, COUNT_ASKED_SITES, static_cast<uint32_t>(e.b.site_table.size / 4) - 1};
    e.record.run("weld_sites", asked, weld, {e.record.counts(), e.b.raw_sites, e.b.site_table, e.b.site_slots});
    struct ResolvePush {
        uint32_t length, length_count;
    } resolve = {0, COUNT_ASKED_SITES};
    e.record.run("resolve_points", asked, resolve,
                 {e.record.counts(), e.b.site_table, e.b.site_slots, e.b.welded_sites, e.b.site_flags});
    e.record.run("flag_sites", asked, engine::NoPush{}, {e.record.counts(), e.b.welded_sites, e.b.placed, e.b.site_flags});
    e.record.scan(asked, e.b.site_flags, e.b.sums, e.b.site_offsets,
                  {{COUNT_SITES, NO_INDEX, NO_INDEX, NO_INDEX}, {n, 0, 0, 0}});
}

void recordBinning(const Event& e) {
    const EventGrid& g = e.grid;
    const Length sites = Length::counted(COUNT_SITES);
    struct BinPush {
        Int4 bins, low;
    } bin = {g.bins, withLast(g.box_low, 0)};
    e.record.run("keep_sites", Length::counted(COUNT_ASKED_SITES), bin,
                 {e.record.counts(), e.b.site_offsets, e.b.raw_sites, e.b.sites, e.b.bin_counts});
    e.record.scan(Length::counted(COUNT_BINS, e.capacity.bins), e.b.bin_counts, e.b.sums, e.b.bin_start, {});
    e.record.run("bin_sites", sites, bin, {e.record.counts(), e.b.sites, e.b.bin_start, e.b.bin_cursors, e.b.loose_sites});
    e.record.run("order_bins", sites, bin, {e.record.counts(), e.b.sites, e.b.bin_start, e.b.loose_sites, e.b.bin_sites});
}

void recordFewSites(const Event& e) {
    struct Push {
        Int4 bins, low;
    } push = {e.grid.bins, withLast(e.grid.box_low, static_cast<int32_t>(e.grid.tiles))};
    const auto& b = e.b;
    e.record.runGroups("sort_few_sites", 1, push,
                       {e.record.counts(), b.raw_sites, b.placed, b.sites, b.bin_start, b.bin_sites, e.record.args()});
}

} // namespace

void recordPlacement(const Event& e) {
    e.record.commands().beginLabel("place_sites");
    const Length vertices = Length::counted(COUNT_MESH_VERTICES);
    if (e.grid.tiles > 1)
        e.record.run("snap_tiles", vertices, e.grid.scale,
                     {e.record.counts(), e.b.mesh_positions, e.b.grid_vertices, e.b.vertex_tiles});
    else
        e.record.run("snap_vertices", vertices, e.grid.scale, {e.record.counts(), e.b.mesh_positions, e.b.grid_vertices});
    if (e.placement->options.given_sites.empty()) recordPatterns(e, *e.placement);
    e.record.commands().endLabel();
}

void recordSites(const Event& e) {
    e.record.commands().beginLabel("neighbor_grid");
    recordKeptSites(e);
    e.record.commands().endLabel();
}

void recordKeptSites(const Event& e) {
    if (e.capacity.sites <= FEW_SITES && e.capacity.bins <= FEW_SITES) return recordFewSites(e);
    e.record.clear({e.b.site_table, e.b.bin_counts, e.b.bin_cursors});
    recordSiteWelding(e);
    recordBinning(e);
}

} // namespace brittle
