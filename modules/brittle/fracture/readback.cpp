#include "modules/brittle/fracture/readback.h"

#include "modules/brittle/fracture/fetch.h"
#include "shaders-spirv/shared/fragment_record.h"

namespace brittle {
namespace {

// From second moments of volume: sums of squares less the axis' own, and products turned over.
std::array<double, 6> inertiaOf(const FragmentRecord& record, double scale) {
    const double xx = static_cast<double>(record.squares[0]), yy = static_cast<double>(record.squares[1]),
                 zz = static_cast<double>(record.squares[2]);
    return {scale * (yy + zz),
            scale * (xx + zz),
            scale * (xx + yy),
            -scale * static_cast<double>(record.products[0]),
            -scale * static_cast<double>(record.products[1]),
            -scale * static_cast<double>(record.products[2])};
}

// `size`: model units in a unit of the records.
Fragment fragmentOf(const FragmentRecord& record, double size, const std::vector<Double3>& sites) {
    Fragment f;
    f.cell = record.fate[2];
    f.first_vertex = 3 * record.range[1];
    f.vertex_count = 3 * (record.range[2] + record.range[3]);
    f.first_index = f.first_vertex;
    f.outer_index_count = 3 * record.range[2];
    f.earlier_index_count = 3 * record.fate[3];
    f.inner_index_count = 3 * record.range[3];
    f.site = f.cell < sites.size() ? sites[f.cell] : Double3{};
    f.volume = static_cast<double>(record.measure[0]) * size * size * size;
    f.inertia = inertiaOf(record, size * size * size * size * size);
    for (size_t k = 0; k < 3; k++) {
        f.centroid[k] = static_cast<double>(record.balance[k]) * size;
        f.lower[k] = record.low[k] * static_cast<float>(size);
        f.upper[k] = record.high[k] * static_cast<float>(size);
    }
    return f;
}

void fillCounts(const std::vector<uint32_t>& status, const FractureOptions& options, FractureResult& result) {
    FractureCounts& c = result.counts;
    c.sites_requested = options.given_sites.empty() ? options.site_count : static_cast<uint32_t>(options.given_sites.size());
    c.sites_used = status[COUNT_SITES];
    c.sites_welded = status[STATUS_WELDED];
    c.cells_merged = status[STATUS_JOINED];
    c.pieces_dissolved = status[STATUS_DISSOLVED];
    c.cells_refused = status[STATUS_BAD_CELLS];
    c.exact_total = status[COUNT_SITES];
    c.exact_redone = status[COUNT_EXACT_SMALL];
    countFilledCells(result);
}

} // namespace

void countFilledCells(FractureResult& result) {
    FractureCounts& c = result.counts;
    std::vector<bool> filled(c.sites_used, false);
    for (const Fragment& f : result.fragments.fragments)
        if (f.cell < filled.size()) filled[f.cell] = true;
    for (bool some : filled)
        (some ? c.cells_ok : c.cells_empty)++;
}

engine::Result<std::vector<uint32_t>> readBack(engine::Device& device, const Mesh& mesh, const EventGrid& grid,
                                               const FractureOptions& options, const EventBuffers& b, const ScenePools& scene,
                                               FractureResult& result, std::vector<uint32_t>& site_tiles) {
    std::vector<uint32_t> status(STATUS_WORDS);
    const Fetch first[] = {{b.counts, status.data(), 4ull * STATUS_WORDS}};
    if (auto ok = fetch(device, first); !ok) return ok.error();
    if (status[STATUS_FAILED] != 0) return status;
    std::vector<Int4> sites(status[COUNT_SITES]);
    std::vector<FragmentRecord> records(status[COUNT_FRAGMENTS]);
    FragmentSet& set = result.fragments;
    set.center = mesh.center;
    set.vertices.resize(3ull * status[COUNT_EMITTED]);
    set.indices.resize(3ull * status[COUNT_EMITTED]);
    const Fetch rest[] = {{b.sites, sites.data(), 16 * sites.size()},
                          {scene.fragments, records.data(), sizeof(FragmentRecord) * records.size()},
                          {scene.vertices, set.vertices.data(), sizeof(FragmentVertex) * set.vertices.size()},
                          {scene.indices, set.indices.data(), 4 * set.indices.size()}};
    if (auto ok = fetch(device, rest); !ok) return ok.error();
    for (const Int4& s : sites) {
        Double3 p = fromGrid(grid, {s[0] & TILE_MASK, s[1] & TILE_MASK, s[2] & TILE_MASK});
        site_tiles.push_back(static_cast<uint32_t>((s[1] >> TILE_BITS) * TILES_IN_ROW + (s[0] >> TILE_BITS)));
        for (size_t k = 0; k < 3; k++)
            p[k] += mesh.center[k];
        result.sites.push_back(p);
    }
    for (const FragmentRecord& record : records)
        set.fragments.push_back(fragmentOf(record, 1 / static_cast<double>(grid.unit()), result.sites));
    fillCounts(status, options, result);
    return status;
}

engine::Result<void> checkStatus(const std::vector<uint32_t>& s) {
    auto failed = [](const std::string& what) { return engine::Error{engine::ErrorCode::Internal, what}; };
    auto number = [&](uint32_t k) { return std::to_string(s[k]); };
    if (s[STATUS_UNPLACED] != 0)
        return engine::Error{engine::ErrorCode::BadInput, number(STATUS_UNPLACED) +
                                                              " sites found no place inside the model, which fills too little "
                                                              "of its box; give the sites with --sites-file"};
    if (s[STATUS_CROWDED] != 0)
        return engine::Error{engine::ErrorCode::Capacity,
                             number(STATUS_CROWDED) +
                                 " sites lie too close together for the spread of the others; leave some out"};
    if (s[STATUS_TOO_LONG] != 0)
        return engine::Error{
            engine::ErrorCode::Capacity,
            number(STATUS_TOO_LONG) +
                " edges or triangles of the model meet too many cells (at most about 6,000 for an edge, 50,000 for "
                "a triangle); divide them, or use fewer sites"};
    if (s[STATUS_BAD_DIAGRAM] != 0) return failed(number(STATUS_BAD_DIAGRAM) + " edges of cells do not close");
    if (s[STATUS_OPEN_OUTLINES] != 0)
        return failed(number(STATUS_OPEN_OUTLINES) + " cut faces have outlines that do not close");
    if (s[STATUS_BAD_CELLS] != 0)
        return engine::Error{engine::ErrorCode::Capacity,
                             number(STATUS_BAD_CELLS) + " cells have too many faces or neighbors to be cut; spread the sites"};
    if (s[STATUS_BAD_CAP] != 0)
        return engine::Error{engine::ErrorCode::Capacity,
                             number(STATUS_BAD_CAP) +
                                 " cut faces have outlines too long to be triangulated; use more sites or a coarser mesh"};
    if (s[STATUS_SIDES] > MOST_SIDES)
        return engine::Error{
            engine::ErrorCode::Capacity,
            "a triangle of the model has more than about 200 sides in one cell; divide it, or spread the sites"};
    if (s[STATUS_BAD_CLIP] != 0) return failed(number(STATUS_BAD_CLIP) + " triangles could not be clipped");
    if (s[STATUS_BAD_LOOKUP] != 0) return failed(number(STATUS_BAD_LOOKUP) + " look-ups in the diagram failed");
    if (s[STATUS_BAD_DEPTH] != 0)
        return failed(number(STATUS_BAD_DEPTH) +
                      " Voronoi edges disagree with the surface; is the mesh closed and free of self-intersections?");
    if (s[STATUS_BAD_UNION] != 0 || s[STATUS_BAD_WELD] != 0) return failed("pieces could not be joined");
    if (s[STATUS_FAILED] != 0) return failed("the event failed without saying why");
    return {};
}

} // namespace brittle
