#include "tests/kernel/device_event.h"

#include "modules/brittle/fracture/known_counts.h"
#include "modules/brittle/fracture/upload.h"
#include "modules/brittle/mesh/primitives.h"

#include <cmath>

namespace kernel_test {
namespace {

using brittle::Double3;

template <class T>
T valueOf(engine::Result<T> result) {
    if (!result) {
        std::fprintf(stderr, "%s\n", result.error().message.c_str());
        std::_Exit(EXIT_FAILURE);
    }
    return std::move(*result);
}

void recordUntil(const brittle::Event& event, Until until) {
    using Record = void (*)(const brittle::Event&);
    constexpr Record kStages[] = {brittle::recordSites,    brittle::recordCells,   brittle::recordClassification,
                                  brittle::recordClipping, brittle::recordPlaces,  brittle::recordDepth,
                                  brittle::recordCaps,     brittle::recordIslands, brittle::recordMassProperties,
                                  brittle::recordEmission};
    brittle::recordPlacement(event);
    for (size_t stage = 0; stage <= static_cast<size_t>(until); ++stage)
        kStages[stage](event);
}

} // namespace

brittle::PreparedMesh solidOf(const brittle::ImportedMesh& imported) { return valueOf(brittle::prepareMesh(imported)); }

brittle::PreparedMesh solidOf(const reference::Triangles& triangles) {
    brittle::ImportedMesh imported;
    for (const reference::Triangle& t : triangles) {
        const uint32_t first = static_cast<uint32_t>(imported.positions.size());
        imported.positions.insert(imported.positions.end(), t.begin(), t.end());
        imported.triangles.push_back({first, first + 1, first + 2});
    }
    imported.corner_normals.resize(imported.positions.size());
    imported.corner_uvs.resize(imported.positions.size());
    return solidOf(imported);
}

brittle::PreparedMesh solidOf(std::string_view builtin) { return solidOf(valueOf(brittle::makeBuiltin(builtin))); }

brittle::FractureOptions latticeSites(double apart) {
    brittle::FractureOptions options;
    for (int z = 0; z < 4; ++z)
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 4; ++x)
                options.given_sites.push_back({(x - 1.5) * apart, (y - 1.5) * apart, (z - 1.5) * apart});
    return options;
}

DeviceEvent::DeviceEvent(const brittle::PreparedMesh& solid, const brittle::FractureOptions& options, Until until)
    : solid_(solid), options_(options) {
    prepare();
    constexpr uint32_t kMaxAttempts = 12;
    for (uint32_t attempt = 0; attempt < kMaxAttempts; ++attempt) {
        recordOnce(until);
        if (!capacity_.grow(words_.data())) break;
    }
    EXPECT_EQ(words_[STATUS_FAILED], 0u);
    for (const uint32_t trouble :
         std::initializer_list<uint32_t>{STATUS_BAD_CELLS, STATUS_BAD_CLIP, STATUS_BAD_LOOKUP, STATUS_BAD_DEPTH, STATUS_BAD_CAP,
                                         STATUS_BAD_UNION, STATUS_BAD_WELD, STATUS_UNPLACED, STATUS_ROUNDS_LEFT})
        EXPECT_EQ(words_[trouble], 0u) << "status word " << trouble;
}

void DeviceEvent::prepare() {
    for (const Double3& site : options_.given_sites) {
        const Double3& center = solid_.mesh.center;
        local_sites_.push_back({site[0] - center[0], site[1] - center[1], site[2] - center[2]});
    }
    const uint32_t count = local_sites_.empty() ? options_.site_count : static_cast<uint32_t>(local_sites_.size());
    grid_ = valueOf(brittle::makeEventGrid(solid_.mesh, local_sites_, count));
    if (local_sites_.empty()) columns_ = brittle::makeColumns(solid_.mesh, grid_);
    capacity_ = brittle::estimateCapacities(solid_.mesh, solid_.topology, grid_, count);
    capacity_.emit_window = 1 << 20;
    capacity_.source_window = 128; // so that most meshes have several parts
}

void DeviceEvent::recordOnce(Until until) {
    engine::Device& device = engine_test::device();
    engine::ScratchArena plan = valueOf(engine::ScratchArena::create(device, 256, "plan"));
    brittle::layOut(plan, capacity_, columns_, buffers_);
    arena_.emplace(valueOf(engine::ScratchArena::create(device, plan.peak(), "event")));
    brittle::layOut(*arena_, capacity_, columns_, buffers_);
    scene_buffers_.emplace(valueOf(brittle::SceneBuffers::create(device, capacity_.emitted, capacity_.fragments)));
    pools_ = scene_buffers_->views();
    engine::Buffer staging;
    onDevice([&](engine::Commands& commands) {
        clear(commands);
        upload(commands, staging);
        brittle::Recorder recorder(commands, kernels(), buffers_.counts, buffers_.args);
        const brittle::Placement placement = {solid_.mesh, options_, columns_};
        recordUntil({.grid = grid_,
                     .capacity = capacity_,
                     .b = buffers_,
                     .scene = pools_,
                     .record = recorder,
                     .turn_budget = 7500,
                     .caps = options_.caps,
                     .placement = &placement},
                    until);
        EXPECT_TRUE(recorder.status().has_value());
    });
    words_ = read<uint32_t>(buffers_.counts, STATUS_WORDS);
}

void DeviceEvent::upload(engine::Commands& commands, engine::Buffer& staging) const {
    std::vector<float> attributes;
    for (size_t k = 0; k < solid_.mesh.corner_normals.size(); ++k) {
        attributes.insert(attributes.end(), solid_.mesh.corner_normals[k].begin(), solid_.mesh.corner_normals[k].end());
        attributes.insert(attributes.end(), solid_.mesh.corner_uvs[k].begin(), solid_.mesh.corner_uvs[k].end());
    }
    std::vector<brittle::Int3> sites;
    for (const Double3& site : local_sites_)
        sites.push_back(brittle::snapToGrid(grid_, site));
    const std::vector<uint32_t> placed(sites.size(), 1);
    const brittle::KnownCounts known =
        brittle::knownCounts(solid_.mesh, solid_.topology, capacity_.sites, capacity_.bins, GROUP_SIZE);
    brittle::Upload upload;
    known.addTo(upload, buffers_.counts, buffers_.args);
    upload.add(std::span(solid_.mesh.positions), buffers_.mesh_positions);
    upload.add(std::span(solid_.mesh.triangles), buffers_.mesh_triangles);
    upload.add(std::span(solid_.topology.triangle_edges), buffers_.triangle_edges);
    upload.add(std::span(solid_.topology.edges), buffers_.mesh_edges);
    std::span<const float> left = attributes;
    for (const engine::BufferView& part : buffers_.corner_attributes) {
        upload.add(left.first(std::min<size_t>(left.size(), part.size / 4)), part);
        left = left.subspan(std::min<size_t>(left.size(), part.size / 4));
    }
    upload.add(std::span(std::as_const(sites)), buffers_.raw_sites);
    upload.add(std::span(placed), buffers_.placed);
    upload.add(std::span(columns_.start), buffers_.column_start);
    upload.add(std::span(columns_.triangles), buffers_.column_triangles);
    upload.add(std::span(columns_.occupied), buffers_.columns);
    staging = valueOf(upload.stage(engine_test::device()));
    upload.copy(commands, staging);
}

// As before an upload; everything else holds a pattern, so that no kernel leans on zeros that its stage has not written.
void DeviceEvent::clear(engine::Commands& commands) const {
    const brittle::EventBuffers& b = buffers_;
    commands.fill(arena_->buffer(), 0xcdcdcdcd);
    for (const engine::BufferView& view : {b.counts, b.args, b.placed, b.raw_sites})
        commands.fill(view, 0);
}

std::vector<reference::GridPoint> DeviceEvent::vertices() const {
    std::vector<reference::GridPoint> vertices;
    for (const brittle::Float3& p : solid_.mesh.positions) {
        reference::GridPoint q;
        for (size_t k = 0; k < 3; ++k)
            q[k] = static_cast<int32_t>(std::lrint(static_cast<double>(p[k]) * static_cast<double>(grid_.scale))) + (1 << 23);
        vertices.push_back(q);
    }
    return vertices;
}

reference::Triangles DeviceEvent::triangles() const {
    const std::vector<reference::GridPoint> places = vertices();
    reference::Triangles triangles;
    for (const brittle::Index3& t : solid_.mesh.triangles) {
        reference::Triangle triangle;
        for (size_t k = 0; k < 3; ++k)
            triangle[k] = {double(places[t[k]][0]), double(places[t[k]][1]), double(places[t[k]][2])};
        triangles.push_back(triangle);
    }
    return triangles;
}

std::vector<reference::GridPoint> DeviceEvent::sites() const {
    std::vector<reference::GridPoint> sites;
    for (const Int4& site : read<Int4>(buffers_.sites, words_[COUNT_SITES]))
        sites.push_back({site[0], site[1], site[2]});
    return sites;
}

} // namespace kernel_test
