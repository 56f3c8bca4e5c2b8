#include "modules/brittle/fracture/fracture.h"

#include "engine/kernel_warmup.h"
#include "modules/brittle/fracture/batch.h"
#include "modules/brittle/fracture/event.h"
#include "modules/brittle/fracture/group_size.h"
#include "modules/brittle/fracture/known_counts.h"
#include "modules/brittle/fracture/radial_sites.h"
#include "modules/brittle/fracture/readback.h"
#include "modules/brittle/fracture/scene_buffers.h"
#include "modules/brittle/fracture/upload.h"
#include "modules/brittle/fracture/warm_kernels.h"
#include "modules/brittle/fracture/wedges.h"
#include "modules/brittle/mesh/vector_math.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <optional>

namespace brittle {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// An event that ran out of room says what it needs; each attempt can find out about one more pool.
constexpr uint32_t kMaxAttempts = 12;

// A workgroup adds up the triangles of a fragment, which may be all of the mesh.
constexpr size_t kMostTriangles = 3'000'000;

// A general buffer this many times larger than an event needs is given back.
constexpr uint64_t kMostSpare = 8;

std::string megabytes(uint64_t bytes) { return std::to_string(bytes / (1024 * 1024)) + " MiB"; }

struct Attempt {
    FractureResult result;
    std::vector<uint32_t> site_tiles; // of the sites used
    std::vector<uint32_t> status;
};

class FractureDevice final : public Fracture {
public:
    FractureDevice(engine::Device& device, uint32_t group_size)
        : device_(device), group_size_(group_size), kernels_(device, shaders::all(), {{FLAT_SIZE_ID, group_size}}),
          warmup_(device, kernels_, kernelsToWarm()) {}

    engine::Result<FractureResult> shatter(const Mesh& mesh, const MeshTopology& topology,
                                           const FractureOptions& options) override {
        auto start = Clock::now();
        if (auto sound = checkOptions(options); !sound) return sound.error();
        if (isRadial(mesh, options)) return shatterRadially(mesh, topology, options);
        auto prepared = prepare(mesh, options);
        if (!prepared) return prepared.error();
        uint32_t count = siteCount(options);
        Capacities capacity = estimateCapacities(mesh, topology, prepared->grid, count);
        capacity = options.only_cells ? forCellsOnly(capacity) : withColliders(capacity, options.collider);
        if (options.caps == Caps::Convex) capacity.nodes = 0;
        capacity.relaxed = options.relax != 0;
        capacity.touching = mayTouchOnGrid(mesh, topology, prepared->grid);
        capacity.sphere_tree = searchOf(options, prepared->grid) == Search::SphereTree;
        capacity.rare = met_.joined(capacity.rare);
        auto attempt = tryUntilItFits(mesh, topology, options, *prepared, capacity);
        if (!attempt) return attempt.error();
        attempt->result.setup_ms = millisecondsSince(start) - attempt->result.total_ms;
        return std::move(attempt->result);
    }

    engine::Result<std::vector<FractureResult>> shatterTogether(std::span<const BreakingObject> objects,
                                                                const FractureOptions& options) override {
        auto start = Clock::now();
        if (auto sound = checkOptions(options); !sound) return sound.error();
        auto batch = joinObjects(objects);
        if (!batch) return batch.error();
        FractureOptions how = howToBreak(options);
        how.site_count = static_cast<uint32_t>(batch->sites.size());
        how.given_sites.resize(batch->sites.size());
        Capacities capacity = withColliders(batch->capacity, options.collider);
        if (options.caps == Caps::Convex) capacity.nodes = 0;
        capacity.rare = met_.joined(capacity.rare);
        const Prepared prepared = {batch->grid, {}, batch->sites, batch->vertex_tiles};
        auto attempt = tryUntilItFits(batch->mesh, batch->topology, how, prepared, capacity);
        if (!attempt) return attempt.error();
        attempt->result.setup_ms = millisecondsSince(start) - attempt->result.total_ms;
        return partResult(*batch, attempt->result, attempt->site_tiles);
    }

private:
    struct Prepared {
        EventGrid grid;
        TriangleColumns columns;
        std::vector<Int3> sites;            // that are given, on the grid
        std::vector<uint32_t> vertex_tiles; // where there are several objects
    };

    engine::Result<void> checkOptions(const FractureOptions& options) const {
        if (options.precision == Precision::Double && !device_.features().doubles)
            return engine::Error{engine::ErrorCode::Device,
                                 device_.name() + " has no 64-bit floats in shaders, which precision double needs; use exact"};
        return checkCollider(options.collider);
    }

    static FractureOptions howToBreak(const FractureOptions& options) {
        FractureOptions how;
        how.search = Search::Grid;
        how.caps = options.caps;
        how.precision = options.precision;
        how.collider = options.collider;
        how.time_kernels = options.time_kernels;
        return how;
    }

    engine::Result<Attempt> tryUntilItFits(const Mesh& mesh, const MeshTopology& topology, const FractureOptions& options,
                                           const Prepared& prepared, Capacities& capacity) {
        for (uint32_t k = 0; k < kMaxAttempts; k++) {
            auto attempt = tryOnce(mesh, topology, options, prepared, capacity);
            if (!attempt) return attempt;
            const bool again = capacity.grow(attempt->status.data());
            met_ = capacity.rare;
            if (again) continue;
            if (auto checked = checkStatus(attempt->status); !checked) return advised(checked.error(), options.precision);
            return attempt;
        }
        return engine::Error{engine::ErrorCode::Capacity, "the event's pools still overflow after " +
                                                              std::to_string(kMaxAttempts) +
                                                              " attempts; use fewer sites or a smaller mesh"};
    }

    static engine::Error advised(engine::Error error, Precision precision) {
        if (precision == Precision::Exact || error.code == engine::ErrorCode::BadInput) return error;
        if (error.code == engine::ErrorCode::Internal) error.code = engine::ErrorCode::BadInput; // it was asked for
        error.message += "; at precision " + std::string(nameOf(precision)) + " that may come of wrong signs: use exact";
        return error;
    }
    // About the hit, and by the paper's pattern about the center of the box even without one.
    static bool sitesCrowd(const FractureOptions& options) {
        return options.given_sites.empty() && (options.pattern == Pattern::Impact || options.pattern == Pattern::Paper);
    }
    static Search searchOf(const FractureOptions& options, const EventGrid& grid) {
        if (options.cells == CellMapping::Edges) return Search::Grid;
        return chosenSearch(options.search, sitesCrowd(options) || grid.fullest_bin > kCrowdedBin);
    }
    static uint32_t siteCount(const FractureOptions& options) {
        return options.given_sites.empty() ? options.site_count : static_cast<uint32_t>(options.given_sites.size());
    }

    static engine::Result<void> checkImpact(const Mesh& mesh, const FractureOptions& options) {
        if (options.pattern == Pattern::Uniform || !options.given_sites.empty()) return {};
        const Impact& impact = options.impact;
        const Double3 from_center = impact.place - mesh.center;
        const double reach = farthestCoordinate(mesh);
        for (double x : from_center)
            if (!(std::fabs(x) <= 16 * reach))
                return engine::Error{
                    engine::ErrorCode::BadInput,
                    "the impact is not finite or lies more than 8 times the model's size away; move it closer"};
        if (!(impact.contact_radius >= 0) || !(impact.favor >= 0))
            return engine::Error{engine::ErrorCode::BadInput, "an impact's strength is negative or no number"};
        if (impact.candidates < 1 || impact.candidates > PAPER_LANES)
            return engine::Error{engine::ErrorCode::BadInput, std::to_string(impact.candidates) +
                                                                  " candidates a site; ask for 1 to " +
                                                                  std::to_string(PAPER_LANES)};
        return {};
    }

    static bool isRadial(const Mesh& mesh, const FractureOptions& options) {
        const bool asks = options.site_count != 0 && !mesh.triangles.empty();
        return asks && options.pattern == Pattern::Radial && options.given_sites.empty();
    }

    engine::Result<FractureResult> shatterRadially(const Mesh& mesh, const MeshTopology& topology,
                                                   const FractureOptions& options) {
        if (auto sound = checkImpact(mesh, options); !sound) return sound.error();
        auto sites = radialSites(mesh, options.impact, options.site_count, options.seed);
        if (!sites) return sites.error();
        FractureOptions given = options;
        given.given_sites = std::move(*sites);
        return shatter(mesh, topology, given);
    }

    static engine::Result<void> checkCollider(uint32_t directions) {
        constexpr uint32_t kKnown[] = {0, 6, 14, 26, 62};
        if (std::ranges::find(kKnown, directions) != std::end(kKnown)) return {};
        return engine::Error{engine::ErrorCode::BadInput, "colliders of " + std::to_string(directions) +
                                                              " directions; ask for 6, 14, 26 or 62, or 0 for none"};
    }

    static engine::Result<Prepared> prepare(const Mesh& mesh, const FractureOptions& options) {
        if (siteCount(options) == 0) return engine::Error{engine::ErrorCode::BadInput, "no sites: ask for at least one"};
        if (options.search == Search::Linear && siteCount(options) > MOST_LINEAR_SITES)
            return engine::Error{engine::ErrorCode::Capacity, "linear search takes at most " +
                                                                  std::to_string(MOST_LINEAR_SITES) +
                                                                  " sites; search by grid or sphere_tree"};
        if (options.cells == CellMapping::Edges && options.search != Search::Auto && options.search != Search::Grid)
            return engine::Error{
                engine::ErrorCode::BadInput,
                "cells by edges find their neighbors by grid only; leave the search out or cut cells by lanes"};
        if (mesh.triangles.empty()) return engine::Error{engine::ErrorCode::BadInput, "the mesh has no triangles"};
        if (mesh.triangles.size() > kMostTriangles)
            return engine::Error{engine::ErrorCode::Capacity,
                                 "the mesh has more than " + std::to_string(kMostTriangles) + " triangles; reduce it"};
        if (auto sound = checkImpact(mesh, options); !sound) return sound.error();
        Prepared p;
        std::vector<Double3> local_sites;
        for (const Double3& site : options.given_sites)
            local_sites.push_back(site - mesh.center);
        auto grid = makeEventGrid(mesh, local_sites, siteCount(options), sitesCrowd(options));
        if (!grid) return grid.error();
        p.grid = *grid;
        for (const Double3& site : local_sites)
            p.sites.push_back(snapToGrid(p.grid, site));
        if (options.given_sites.empty() || options.relax != 0) p.columns = makeColumns(mesh, p.grid);
        return p;
    }

    static void addInParts(Upload& upload, std::span<const float> values, const std::vector<engine::BufferView>& parts) {
        for (const engine::BufferView& part : parts) {
            const size_t count = std::min<size_t>(values.size(), part.size / sizeof(float));
            if (count > 0) upload.add(values.first(count), part);
            values = values.subspan(count);
        }
    }

    // Copies of the host's arrays live until the upload buffer is filled.
    static void addMesh(Upload& upload, const Mesh& mesh, const MeshTopology& topology, std::vector<float>& attributes,
                        const EventBuffers& b) {
        attributes.reserve(5 * mesh.corner_normals.size());
        for (size_t k = 0; k < mesh.corner_normals.size(); k++) {
            attributes.insert(attributes.end(), mesh.corner_normals[k].begin(), mesh.corner_normals[k].end());
            attributes.insert(attributes.end(), mesh.corner_uvs[k].begin(), mesh.corner_uvs[k].end());
        }
        upload.add(std::span(mesh.positions), b.mesh_positions);
        upload.add(std::span(mesh.triangles), b.mesh_triangles);
        upload.add(std::span(topology.triangle_edges), b.triangle_edges);
        upload.add(std::span(topology.edges), b.mesh_edges);
        addInParts(upload, attributes, b.corner_attributes);
    }

    static void addSites(Upload& upload, const Prepared& p, std::vector<uint32_t>& placed, const EventBuffers& b) {
        placed.assign(p.sites.size(), 1);
        upload.add(std::span(p.sites), b.raw_sites);
        upload.add(std::span(p.vertex_tiles), b.vertex_tiles);
        upload.add(std::span(std::as_const(placed)), b.placed);
        upload.add(std::span(p.columns.start), b.column_start);
        upload.add(std::span(p.columns.triangles), b.column_triangles);
        upload.add(std::span(p.columns.occupied), b.columns);
    }

    // The general buffer is kept from event to event: fresh memory costs a page fault for every page that a kernel touches.
    engine::Result<void> layOutArena(const Capacities& c, const TriangleColumns& columns, EventBuffers& b) {
        auto plan = engine::ScratchArena::create(device_, 256, "plan");
        if (!plan) return plan.error();
        const uint64_t largest = layOut(*plan, c, columns, b), most = device_.limits().maxStorageBufferRange;
        if (largest > most)
            return engine::Error{engine::ErrorCode::Capacity, "the event's largest list has " + megabytes(largest) +
                                                                  ", the device can bind " + megabytes(most) +
                                                                  "; use fewer sites or a smaller mesh"};
        const bool fits = arena_ && arena_->capacity() >= plan->peak() && arena_->capacity() / kMostSpare <= plan->peak();
        if (!fits) {
            arena_.reset();
            auto made = engine::ScratchArena::create(device_, plan->peak(), "general buffer");
            if (!made) return made.error();
            arena_ = std::move(*made);
        }
        arena_->reset();
        layOut(*arena_, c, columns, b);
        return arena_->status();
    }

    engine::Result<Attempt> tryOnce(const Mesh& mesh, const MeshTopology& topology, const FractureOptions& options,
                                    const Prepared& p, Capacities& capacity) {
        EventBuffers b;
        capacity.emit_window = emitWindow(device_.limits());
        capacity.source_window = sourceWindow(device_.limits());
        if (auto ok = layOutArena(capacity, p.columns, b); !ok) return ok.error();
        auto scene = SceneBuffers::create(device_, capacity.emitted, capacity.fragments);
        if (!scene) return scene.error();
        auto colliders = ColliderBuffers::create(device_, capacity);
        if (!colliders) return colliders.error();
        engine::Commands commands(device_);
        if (auto ok = commands.begin(); !ok) return ok.error();
        if (options.time_kernels) commands.timeKernels();
        Upload upload;
        std::vector<float> attributes;
        std::vector<uint32_t> placed;
        const KnownCounts known = knownCounts(mesh, topology, capacity.sites, capacity.bins, group_size_);
        known.addTo(upload, b.counts, b.args);
        addMesh(upload, mesh, topology, attributes, b);
        addSites(upload, p, placed, b);
        auto staging = upload.stage(device_);
        if (!staging) return staging.error();
        Recorder recorder(commands, kernels_, b.counts, b.args, options.precision);
        recorder.clear({b.counts, b.args, b.placed, b.raw_sites});
        upload.copy(commands, *staging);
        const Search search = searchOf(options, p.grid);
        const Placement placement = {mesh, options, p.columns};
        const Event event = {.grid = p.grid,
                             .capacity = capacity,
                             .b = b,
                             .scene = scene->views(),
                             .record = recorder,
                             .search = search,
                             .turn_budget = turnBudget(device_, group_size_, search, capacity.sites),
                             .colliders = colliders->views(),
                             .cells = options.cells,
                             .caps = options.caps,
                             .only_cells = options.only_cells,
                             .placement = &placement};
        recordPlacement(event);
        recordFracture(event);
        if (auto ok = recorder.status(); !ok) return ok.error();
        auto start = Clock::now();
        if (auto ok = commands.submitAndWait(); !ok) return ok.error();
        Attempt attempt;
        attempt.result.total_ms = millisecondsSince(start);
        auto timings = commands.timings();
        if (!timings) return timings.error();
        attempt.result.timings = std::move(*timings);
        auto read = readBack(device_, mesh, p.grid, options, b, scene->views(), attempt.result, attempt.site_tiles);
        if (!read) return read.error();
        attempt.status = std::move(*read);
        if (capacity.collider_directions == 0 || attempt.status[STATUS_FAILED] != 0) return attempt;
        auto set = readColliders(device_, attempt.status, b, colliders->views());
        if (!set) return set.error();
        attempt.result.fragments.colliders = std::move(*set);
        return attempt;
    }

    engine::Device& device_;
    uint32_t group_size_;
    std::optional<engine::ScratchArena> arena_;
    engine::KernelLibrary kernels_;
    engine::KernelWarmup warmup_;
    Capacities::Rare met_; // by earlier events: recorded from the start, since a second attempt costs more than idle dispatches
};

} // namespace

engine::Result<std::unique_ptr<Fracture>> Fracture::create(engine::Device& device, uint32_t group_size) {
    if (group_size == 0) group_size = GROUP_SIZE;
    if (auto sound = checkGroupSize(group_size, device.limits()); !sound) return sound.error();
    return std::unique_ptr<Fracture>(std::make_unique<FractureDevice>(device, group_size));
}

} // namespace brittle
