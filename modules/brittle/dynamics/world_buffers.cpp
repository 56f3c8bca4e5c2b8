#include "modules/brittle/dynamics/world_buffers.h"

#include "modules/brittle/dynamics/sibling_contacts.h"
#include "modules/brittle/dynamics/step_layout.h"
#include "modules/brittle/fracture/upload.h"
#include "shaders-spirv/shared/breaking.h"
#include "shaders-spirv/shared/impact.h"

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

constexpr uint64_t kDummyBytes = 16;

// Makes buffers until one cannot be made.
class Maker {
public:
    Maker(Device& device, WorldBuffers& buffers) : device_(device), buffers_(buffers) {
        dummy_ = make("dummy", std::nullopt, 1, kDummyBytes);
    }

    // What no effect of the world asks for is the dummy.
    BufferView make(std::string_view name, std::optional<Effect> asked_by, uint64_t count, uint64_t size) {
        const bool wanted = !asked_by || buffers_.sizes.effects.has(*asked_by);
        const BufferView view = wanted ? makeAlone(name, count, size) : dummy_;
        buffers_.named.push_back({std::string(name), view, wanted ? view.size : 0, asked_by});
        return view;
    }
    const BufferView& dummy() const { return dummy_; }
    Result<void> status() const {
        if (failure_) return *failure_;
        return {};
    }

private:
    BufferView makeAlone(std::string_view name, uint64_t count, uint64_t size) {
        if (count * size > device_.limits().maxStorageBufferRange) refuse(name, count * size);
        if (failure_) return {};
        auto made = Buffer::create(device_, std::max(count * size, kDummyBytes), BufferDomain::Device, 0, name);
        if (!made) {
            failure_ = made.error();
            return {};
        }
        buffers_.owned.push_back(std::make_unique<Buffer>(std::move(*made)));
        return *buffers_.owned.back();
    }
    void refuse(std::string_view name, uint64_t bytes) {
        if (failure_) return;
        failure_ = Error{ErrorCode::Capacity, "the world's list of " + std::string(name) + " has " +
                                                  std::to_string((bytes + (1 << 20) - 1) >> 20) + " MiB, the device can bind " +
                                                  std::to_string(device_.limits().maxStorageBufferRange >> 20) +
                                                  "; use fewer bodies or a smaller budget"};
    }

    Device& device_;
    WorldBuffers& buffers_;
    BufferView dummy_;
    std::optional<Error> failure_;
};

// The arena is planned by taking all from one that is too small.
Result<void> makeArena(Device& device, const BufferView& dummy, WorldBuffers& b) {
    auto plan = engine::ScratchArena::create(device, 256, "plan");
    if (!plan) return plan.error();
    const std::vector<NamedBuffer> lasting = b.named;
    static_cast<void>(layOutStep(*plan, dummy, b));
    auto arena = engine::ScratchArena::create(device, plan->peak(), "dynamics");
    if (!arena) return arena.error();
    b.arena = std::make_unique<engine::ScratchArena>(std::move(*arena));
    b.named = lasting;
    return layOutStep(*b.arena, dummy, b);
}

void makeHulls(Maker& maker, const WorldContents& c, WorldBuffers& b) {
    const auto make = [&](std::string_view name, uint64_t count, uint64_t size) {
        return maker.make(name, Effect::Contacts, count, size);
    };
    b.hull_records = make("hulls", c.hulls.records.size(), sizeof(gpu::HullRecord));
    b.hull_vertices = make("hull vertices", c.hulls.vertices.size(), sizeof(gpu::vec4));
    b.hull_faces = make("hull faces", c.hulls.faces.size(), sizeof(gpu::HullFace));
    b.hull_corners = make("hull corners", c.hulls.corners.size(), 4);
    b.hull_edges = make("hull edges", c.hulls.edges.size(), sizeof(gpu::uvec4));
    b.pieces = make("pieces", c.pieces.size(), sizeof(gpu::PieceRecord));
    for (size_t parity = 0; parity < b.memory.size(); parity++) {
        const std::string when = parity == 0 ? " of even steps" : " of odd steps";
        b.memory[parity].pairs = make("pairs" + when, b.sizes.pairs, 8);
        b.memory[parity].count = make("pair count" + when, 4, 4);
        b.memory[parity].contacts = make("contacts" + when, b.sizes.pairs, sizeof(gpu::ContactMemory));
    }
}

void makeLasting(Maker& maker, const WorldContents& c, WorldBuffers& b) {
    const auto make = [&](std::string_view name, uint64_t count, uint64_t size) {
        return maker.make(name, std::nullopt, count, size);
    };
    b.bodies = make("bodies", c.bodies.size(), sizeof(gpu::BodyState));
    b.shapes = make("shapes", c.shapes.size(), sizeof(gpu::BodyShape));
    b.counts = make("counts", STATUS_WORDS, 4);
    b.args = make("arguments", 9 * COUNT_TOTAL, 4);
    b.steps = make("steps", STEPS_WORDS, 4);
    b.births = maker.make("births", Effect::ImpactFracture, c.bodies.size(), sizeof(gpu::Birth));
    const uint64_t impacts = b.sizes.effects.has(Effect::Contacts) ? IMPACT_EVENTS : 0;
    b.impacts_told = maker.make("impacts told", Effect::Events, IMPACT_WORDS, 4);
    b.impacts = maker.make("impacts", Effect::Events, impacts, sizeof(gpu::ImpactEvent));
    makeHulls(maker, c, b);
}

// Hulls, and what is known of contacts before the first step. `first` and `count` outlive the upload.
void addContacts(Upload& upload, const WorldContents& c, const WorldBuffers& b, const FirstContacts& first,
                 const uint32_t& count) {
    upload.add(std::span(c.hulls.records), b.hull_records);
    upload.add(std::span(c.hulls.vertices), b.hull_vertices);
    upload.add(std::span(c.hulls.faces), b.hull_faces);
    upload.add(std::span(c.hulls.corners), b.hull_corners);
    upload.add(std::span(c.hulls.edges), b.hull_edges);
    upload.add(std::span(c.pieces), b.pieces);
    const PairMemory& before = b.memory[1]; // that the first step looks back at
    upload.add(std::span(first.pairs).first(count), before.pairs);
    upload.add(std::span(first.contacts).first(count), before.contacts);
    upload.add(std::span(&count, 1), before.count);
}

// Slots that hold nothing yet lie behind those that do.
std::array<uint32_t, STEPS_WORDS> firstSteps(const WorldContents& c) {
    const auto absent = [](const gpu::BodyState& body) { return (body.sector.w & BODY_ABSENT) != 0; };
    const auto unused = [](const gpu::PieceRecord& piece) { return piece.ids.y == NO_INDEX; };
    const auto bodies = std::ranges::find_if(c.bodies, absent) - c.bodies.begin();
    const auto pieces = std::ranges::find_if(c.pieces, unused) - c.pieces.begin();
    return {0, 0, static_cast<uint32_t>(bodies), static_cast<uint32_t>(pieces), 0, 0};
}

Result<void> fill(Device& device, const WorldContents& c, const WorldBuffers& b) {
    Upload upload;
    const std::array<uint32_t, STEPS_WORDS> steps = firstSteps(c);
    upload.add(std::span<const uint32_t>(steps), b.steps);
    upload.add(std::span(c.bodies), b.bodies);
    upload.add(std::span(c.shapes), b.shapes);
    const bool contacts = b.sizes.effects.has(Effect::Contacts);
    const FirstContacts first = contacts ? firstContacts(c) : FirstContacts();
    const auto count = static_cast<uint32_t>(std::min<size_t>(first.pairs.size(), b.sizes.pairs));
    if (contacts) addContacts(upload, c, b, first, count);
    auto staging = upload.stage(device);
    if (!staging) return staging.error();
    engine::Commands commands(device);
    if (auto begun = commands.begin(); !begun) return begun;
    for (const PairMemory& memory : b.memory)
        commands.fill(memory.count, 0);
    for (const BufferView* view : {&b.counts, &b.args, &b.births, &b.impacts_told})
        commands.fill(*view, 0);
    upload.copy(commands, *staging);
    return commands.submitAndWait();
}

} // namespace

uint32_t mostPairs(const Device& device) {
    constexpr uint64_t kLargest = std::max({sizeof(gpu::SolverContact), sizeof(gpu::ContactMemory), sizeof(gpu::Manifold)});
    return static_cast<uint32_t>(std::min<uint64_t>(device.limits().maxStorageBufferRange / kLargest, UINT32_MAX / 4));
}

Result<WorldBuffers> makeWorldBuffers(Device& device, const WorldContents& contents, uint32_t pairs, uint32_t contacts,
                                      EffectSet effects) {
    if (const uint32_t most = mostPairs(device); pairs > most)
        return Error{ErrorCode::Capacity, "a budget of " + std::to_string(pairs) + " pairs, the device has room for " +
                                              std::to_string(most) + "; use fewer pieces or a smaller budget"};
    WorldBuffers b;
    b.sizes = {static_cast<uint32_t>(contents.bodies.size()), static_cast<uint32_t>(contents.pieces.size()), pairs,
               contacts == 0 ? pairs : std::min(contacts, pairs), effects};
    b.broad_phase = {b.sizes.pieces, pairs, chosenSort(b.sizes.pieces, device.isCpu())};
    b.movers =
        static_cast<uint32_t>(std::ranges::count_if(contents.bodies, [](const auto& body) { return body.offset.w != 0; }));
    Maker maker(device, b);
    makeLasting(maker, contents, b);
    if (auto made = maker.status(); !made) return made.error();
    if (auto made = makeArena(device, maker.dummy(), b); !made) return made.error();
    if (auto filled = fill(device, contents, b); !filled) return filled.error();
    return b;
}

} // namespace brittle
