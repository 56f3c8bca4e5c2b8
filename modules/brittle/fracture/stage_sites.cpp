// Sites: placed in the mesh or given, welded where they fall together, and sorted into the bins of the search grid.
#include "modules/brittle/fracture/event.h"

namespace brittle {
namespace {

constexpr uint32_t kPlacementRounds = 4, kTriesPerRound = 512;

struct PlacePush {
    int32_t low[4], high[4];
    uint32_t site_count, occupied, seed_low, seed_high, first_try;
};

void recordPlacement(const Event& e) {
    const EventGrid& g = e.grid;
    PlacePush push = {{g.mesh_low[0], g.mesh_low[1], g.mesh_low[2], e.columns.edge},
                      {g.mesh_high[0], g.mesh_high[1], g.mesh_high[2], e.columns.per_row},
                      e.capacity.sites,
                      static_cast<uint32_t>(e.columns.occupied.size()),
                      static_cast<uint32_t>(e.options.seed),
                      static_cast<uint32_t>(e.options.seed >> 32),
                      0};
    for (uint32_t round = 0; round < kPlacementRounds; round++) {
        push.first_try = round * kTriesPerRound;
        e.record.run("place_sites", Length::of(e.capacity.sites), push,
                     {e.record.counts(), e.b.grid_vertices, e.b.mesh_triangles, e.b.column_start, e.b.column_triangles,
                      e.b.columns, e.b.raw_sites, e.b.placed});
    }
}

void recordSiteWelding(const Event& e) {
    uint32_t n = e.capacity.sites;
    struct WeldPush {
        uint32_t length, length_count, table_mask;
    } weld = {n, NO_INDEX, static_cast<uint32_t>(e.b.site_table.size / 4) - 1};
    e.record.run("weld_sites", Length::of(n), weld, {e.record.counts(), e.b.raw_sites, e.b.site_table, e.b.site_slots});
    struct ResolvePush {
        uint32_t length, length_count;
    } resolve = {n, NO_INDEX};
    e.record.run("resolve_points", Length::of(n), resolve,
                 {e.record.counts(), e.b.site_table, e.b.site_slots, e.b.welded_sites, e.b.site_flags});
    e.record.run("flag_sites", Length::of(n), n, {e.record.counts(), e.b.welded_sites, e.b.placed, e.b.site_flags});
    e.record.scan(Length::of(n), e.b.site_flags, e.b.sums, e.b.site_offsets,
                  {{COUNT_SITES, NO_INDEX, NO_INDEX, NO_INDEX}, {n, 0, 0, 0}});
}

void recordBinning(const Event& e) {
    const EventGrid& g = e.grid;
    struct Push {
        int32_t bins[4], low[4];
        uint32_t site_count;
    } keep = {{g.bins[0], g.bins[1], g.bins[2], g.bins[3]}, {g.box_low[0], g.box_low[1], g.box_low[2], 0}, e.capacity.sites};
    e.record.run("keep_sites", Length::of(e.capacity.sites), keep,
                 {e.b.site_offsets, e.b.raw_sites, e.b.sites, e.b.bin_counts});
    e.record.scan(Length::of(e.capacity.bins), e.b.bin_counts, e.b.sums, e.b.bin_start, {});
    struct BinPush {
        Int4 bins, low;
    } bin = {g.bins, {g.box_low[0], g.box_low[1], g.box_low[2], 0}};
    e.record.run("bin_sites", Length::of(e.capacity.sites), bin,
                 {e.record.counts(), e.b.sites, e.b.bin_start, e.b.bin_cursors, e.b.loose_sites});
    e.record.run("order_bins", Length::of(e.capacity.sites), bin,
                 {e.record.counts(), e.b.sites, e.b.bin_start, e.b.loose_sites, e.b.bin_sites});
}

} // namespace

void recordSites(const Event& e) {
    struct SnapPush {
        uint32_t length;
        float scale;
    } snap = {e.capacity.vertices, e.grid.scale};
    e.record.commands().beginLabel("place_sites");
    e.record.clear({e.b.site_table, e.b.bin_counts, e.b.bin_cursors});
    e.record.run("snap_vertices", Length::of(e.capacity.vertices), snap, {e.b.mesh_positions, e.b.grid_vertices});
    if (e.options.given_sites.empty()) recordPlacement(e);
    recordSiteWelding(e);
    e.record.commands().endLabel();
    e.record.commands().beginLabel("neighbor_grid");
    recordBinning(e);
    e.record.commands().endLabel();
}

} // namespace brittle
