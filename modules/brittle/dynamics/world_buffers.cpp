#include "modules/brittle/dynamics/world_buffers.h"

#include "modules/brittle/dynamics/sibling_contacts.h"
#include "modules/brittle/fracture/upload.h"
#include "shaders-spirv/shared/narrow_phase.h"

#include <algorithm>
#include <string>

namespace brittle {
namespace {

using engine::Buffer;
using engine::BufferDomain;
using engine::BufferView;
using engine::Device;
using engine::Error;
using engine::ErrorCode;
using engine::Result;

// Makes buffers until one cannot be made.
class Maker {
public:
    explicit Maker(Device& device) : device_(device) {}

    Buffer make(std::string_view name, uint64_t count, uint64_t size) {
        if (!failure_) {
            if (count * size > device_.limits().maxStorageBufferRange) refuse(name, count * size);
            auto made = failure_ ? Result<Buffer>(*failure_)
                                 : Buffer::create(device_, std::max<uint64_t>(count * size, 16), BufferDomain::Device, 0, name);
            if (made) return std::move(*made);
            failure_ = made.error();
        }
        return {};
    }
    Result<void> status() const {
        if (failure_) return *failure_;
        return {};
    }

private:
    void refuse(std::string_view name, uint64_t bytes) {
        failure_ = Error{ErrorCode::Capacity, "the world's list of " + std::string(name) + " has " +
                                                  std::to_string((bytes + (1 << 20) - 1) >> 20) + " MiB, the device can bind " +
                                                  std::to_string(device_.limits().maxStorageBufferRange >> 20) +
                                                  "; use fewer bodies or a smaller budget"};
    }

    Device& device_;
    std::optional<Error> failure_;
};

StepBuffers layOutStep(engine::ScratchArena& arena, const WorldSizes& n) {
    StepBuffers s;
    const auto take = [&](uint64_t count, uint64_t size) { return arena.take(count * size); };
    s.box_low = take(n.pieces, 16);
    s.box_high = take(n.pieces, 16);
    for (BufferView* view : {&s.recalled, &s.fresh, &s.touches})
        *view = take(n.pairs, 4);
    for (BufferView* view : {&s.contact_pairs, &s.contact_slots})
        *view = take(n.contacts, 4);
    for (BufferView* view : {&s.fresh_slots, &s.contact_offsets})
        *view = take(n.pairs + 1ull, 4);
    s.sums = take((std::max(n.pairs, n.bodies) + SCAN_BLOCK - 1ull) / SCAN_BLOCK, 4);
    s.fresh_pairs = take(n.pairs, 8);
    s.manifolds = take(n.pairs, sizeof(gpu::Manifold));
    s.axes = take(n.pairs, sizeof(gpu::AxisRecord));
    s.narrow_arguments = take(1, kNarrowPhaseArgumentBytes);
    s.solver_bodies = take(n.bodies, sizeof(gpu::SolverBody));
    s.spins = take(n.bodies, 16);
    s.shares = take(n.bodies, 4);
    s.solver_contacts = take(n.contacts, sizeof(gpu::SolverContact));
    for (BufferView* view : {&s.parents, &s.islands, &s.rests, &s.island_contacts})
        *view = take(n.sleeping ? n.bodies : 0, 4);
    s.island_ranges = take(n.sleeping ? n.bodies : 0, 8);
    for (BufferView* view : {&s.listed, &s.color_ends})
        *view = take(n.sleeping ? n.contacts : 0, 4);
    s.body_colors = take(n.bodies, 8);
    s.bids = take(n.bodies, 4);
    s.waiting = take(n.contacts, 8);
    s.color_start = take(COLOR_WORDS, 4);
    s.adjacency_counts = take(n.bodies, 4);
    s.adjacency_cursors = take(n.bodies, 4);
    s.adjacency_start = take(n.bodies + 1ull, 4);
    s.loose_adjacency = take(2ull * n.contacts, 4);
    s.adjacency = take(2ull * n.contacts, 4);
    return s;
}

Result<void> layOut(WorldBuffers& b, engine::ScratchArena& arena) {
    b.step = layOutStep(arena, b.sizes);
    auto scratch = layOutBroadPhase(arena, b.broad_phase);
    if (!scratch) return scratch.error();
    b.step.broad_phase = *scratch;
    return arena.status();
}

// The arena is planned by taking all from one that is too small.
Result<void> makeArena(Device& device, WorldBuffers& b) {
    auto plan = engine::ScratchArena::create(device, 256, "plan");
    if (!plan) return plan.error();
    layOutStep(*plan, b.sizes);
    const uint64_t bytes = plan->peak() + broadPhaseBytes(b.broad_phase) + (1 << 16);
    auto arena = engine::ScratchArena::create(device, bytes, "dynamics");
    if (!arena) return arena.error();
    b.arena = std::make_unique<engine::ScratchArena>(std::move(*arena));
    return layOut(b, *b.arena);
}

void makeLasting(Maker& maker, const WorldContents& c, WorldBuffers& b) {
    b.hull_records = maker.make("hulls", c.hulls.records.size(), sizeof(gpu::HullRecord));
    b.hull_vertices = maker.make("hull vertices", c.hulls.vertices.size(), sizeof(gpu::vec4));
    b.hull_faces = maker.make("hull faces", c.hulls.faces.size(), sizeof(gpu::HullFace));
    b.hull_corners = maker.make("hull corners", c.hulls.corners.size(), 4);
    b.hull_edges = maker.make("hull edges", c.hulls.edges.size(), sizeof(gpu::uvec4));
    b.pieces = maker.make("pieces", c.pieces.size(), sizeof(gpu::PieceRecord));
    b.bodies = maker.make("bodies", c.bodies.size(), sizeof(gpu::BodyState));
    b.shapes = maker.make("shapes", c.shapes.size(), sizeof(gpu::BodyShape));
    b.counts = maker.make("counts", STATUS_WORDS, 4);
    b.args = maker.make("arguments", 9 * COUNT_TOTAL, 4);
    b.steps = maker.make("steps", 4, 4);
    for (PairMemory& memory : b.memory) {
        memory.pairs = maker.make("pairs", b.sizes.pairs, 8);
        memory.count = maker.make("pair count", 4, 4);
        memory.contacts = maker.make("contacts", b.sizes.pairs, sizeof(gpu::ContactMemory));
    }
}

Result<void> fill(Device& device, const WorldContents& c, const WorldBuffers& b) {
    Upload upload;
    upload.add(std::span(c.hulls.records), b.hull_records);
    upload.add(std::span(c.hulls.vertices), b.hull_vertices);
    upload.add(std::span(c.hulls.faces), b.hull_faces);
    upload.add(std::span(c.hulls.corners), b.hull_corners);
    upload.add(std::span(c.hulls.edges), b.hull_edges);
    upload.add(std::span(c.pieces), b.pieces);
    upload.add(std::span(c.bodies), b.bodies);
    upload.add(std::span(c.shapes), b.shapes);
    const FirstContacts first = firstContacts(c);
    const auto count = static_cast<uint32_t>(std::min<size_t>(first.pairs.size(), b.sizes.pairs));
    const PairMemory& before = b.memory[1]; // that the first step looks back at
    upload.add(std::span(first.pairs).first(count), before.pairs);
    upload.add(std::span(first.contacts).first(count), before.contacts);
    upload.add(std::span(&count, 1), before.count);
    auto staging = upload.stage(device);
    if (!staging) return staging.error();
    engine::Commands commands(device);
    if (auto begun = commands.begin(); !begun) return begun;
    for (const PairMemory& memory : b.memory)
        commands.fill(memory.count, 0);
    for (const Buffer* buffer : {&b.counts, &b.args, &b.steps})
        commands.fill(*buffer, 0);
    upload.copy(commands, *staging);
    return commands.submitAndWait();
}

} // namespace

uint32_t mostPairs(const Device& device) {
    constexpr uint64_t kLargest = std::max({sizeof(gpu::SolverContact), sizeof(gpu::ContactMemory), sizeof(gpu::Manifold)});
    return static_cast<uint32_t>(std::min<uint64_t>(device.limits().maxStorageBufferRange / kLargest, UINT32_MAX / 4));
}

Result<WorldBuffers> makeWorldBuffers(Device& device, const WorldContents& contents, uint32_t pairs, uint32_t contacts,
                                      bool sleeping) {
    if (const uint32_t most = mostPairs(device); pairs > most)
        return Error{ErrorCode::Capacity, "a budget of " + std::to_string(pairs) + " pairs, the device has room for " +
                                              std::to_string(most) + "; use fewer pieces or a smaller budget"};
    WorldBuffers b;
    b.sizes = {static_cast<uint32_t>(contents.bodies.size()), static_cast<uint32_t>(contents.pieces.size()), pairs,
               contacts == 0 ? pairs : std::min(contacts, pairs), sleeping};
    b.broad_phase = {b.sizes.pieces, pairs, chosenSort(b.sizes.pieces, device.isCpu())};
    b.movers =
        static_cast<uint32_t>(std::ranges::count_if(contents.bodies, [](const auto& body) { return body.offset.w != 0; }));
    Maker maker(device);
    makeLasting(maker, contents, b);
    if (auto made = maker.status(); !made) return made.error();
    if (auto made = makeArena(device, b); !made) return made.error();
    if (auto filled = fill(device, contents, b); !filled) return filled.error();
    return b;
}

} // namespace brittle
