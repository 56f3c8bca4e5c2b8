#include "modules/brittle/breaking/breaking.h"

#include "engine/arena.h"
#include "modules/brittle/breaking/adopt.h"
#include "modules/brittle/breaking/breaking_buffers.h"
#include "modules/brittle/breaking/debris.h"
#include "modules/brittle/breaking/dust.h"
#include "modules/brittle/breaking/turning.h"
#include "modules/brittle/dynamics/event_ring.h"
#include "modules/brittle/fracture/fetch.h"
#include "modules/brittle/fracture/upload.h"
#include "shaders-spirv/shared/fragment_record.h"

#include <algorithm>
#include <optional>
#include <string>

namespace brittle {
namespace {

using engine::BufferView;
using engine::Device;
using engine::Error;
using engine::ErrorCode;
using engine::Result;

constexpr uint32_t kDirections = 26; // of the pieces that fragments collide by
constexpr float kPause = 0.25f;      // s, in which what could not be broken is left alone
constexpr float kForEver = 3e38f;
constexpr uint32_t kOwnerBits = 8; // of the numbers of objects that break at once
static_assert(MOST_BREAKING == 1 << kOwnerBits);

BreakingRoom eventRoomOf(const RoomToBreak& room) {
    return {roomFor(room.step_bodies, room.step_triangles), room.step_sites, room.most_fragments, room.touching};
}

std::string largestBody(const WorldContents& contents) {
    const auto trianglesOf = [](const gpu::BreakableBody& body) { return body.surface.y + body.surface.z; };
    const auto largest = std::ranges::max_element(contents.breakable, {}, trianglesOf);
    return contents.names[static_cast<size_t>(largest - contents.breakable.begin())];
}

// Bytes of the largest list of an event.
Result<uint64_t> largestListOf(Device& device, const RoomToBreak& room) {
    BreakingEvent event = planBreaking(device, GROUP_SIZE, eventRoomOf(room), kDirections);
    auto plan = engine::ScratchArena::create(device, 256, "plan");
    if (!plan) return plan.error();
    layOutBreaking(*plan, event);
    return std::max<uint64_t>(plan->largest(), uint64_t{event.capacity.emitted} * 3 * sizeof(FragmentVertex));
}

class DeviceBreaking final : public Breaking {
public:
    DeviceBreaking(Device& device, const RoomToBreak& room, const StepSettings& settings)
        : device_(device), room_(room), settings_(settings), effects_(effectsOf(settings)) {}

    Result<void> make(const WorldContents& contents, uint32_t pairs, uint32_t group_size) {
        event_ = planBreaking(device_, group_size, eventRoomOf(room_), kDirections);
        sizes_ = {pairs, static_cast<uint32_t>(contents.bodies.size()), event_.capacity.fragments};
        // More fragments than that, and objects stay whole for want of room.
        room_.pools.requests = std::min<uint32_t>(event_.capacity.fragments, POOL_MOST_REQUESTS);
        if (auto made = makeBuffers(contents); !made) return made;
        if (auto made = makeSmall(contents); !made) return made;
        return fill(contents);
    }

    Result<std::unique_ptr<Strikes>> makeStrikes() const override {
        return Strikes::create(device_, sizes_.bodies, room_.pools.capacity[POOL_PIECES]);
    }

    void recordStrikes(const Step& s, const Strikes& strikes, const HandBlows& by_hand) const override {
        strikes.recordJudging(s, l_, by_hand);
    }

    Result<void> recordBlows(const Step& s, const Strikes* strikes) override {
        const auto& world = s.record.counts();
        s.record.commands().beginLabel("blows");
        s.record.clear({p_.hardest, event_.b.counts, event_.b.args});
        for (const BufferView& least : {p_.soonest, p_.chosen})
            s.record.commands().fill(least, NO_INDEX);
        const MeetingPush meeting = meetingPush(s);
        s.record.run("find_blows", Length::counted(COUNT_BOX_PAIRS), meeting,
                     {world, s.now.contacts, s.b.bodies, s.b.step.solver_bodies, s.b.step.touches, l_.breakable, l_.cards,
                      s.b.steps, p_.blows, p_.turning, s.b.shapes});
        if (auto recorded = recordTurning(s, l_, p_); !recorded) return recorded;
        if (strikes != nullptr) strikes->recordRaising(s, l_, p_);
        const uint32_t publish[] = {COUNT_STRUCK, COUNT_BOX_PAIRS, COUNT_BLOWS};
        s.record.runGroups("publish_if", 1, publish, {world, s.record.args()});
        recordOrder(s);
        s.record.run("choose_blows", Length::counted(COUNT_STRUCK), engine::NoPush{},
                     {world, s.now.contacts, p_.blows, p_.hardest, p_.chosen});
        s.record.run("hold_blows", Length::counted(COUNT_STRUCK), engine::NoPush{},
                     {world, s.now.contacts, s.b.bodies, p_.blows, p_.chosen, s.b.step.touches, s.b.step.shares});
        s.record.run("leave_unmet", Length::counted(COUNT_STRUCK), meeting,
                     {world, s.now.contacts, s.b.bodies, s.b.step.solver_bodies, s.b.step.shares, p_.blows, p_.chosen,
                      s.b.step.touches});
        if (strikes != nullptr) strikes->recordChoice(s, p_);
        s.record.commands().endLabel();
        return {};
    }

    void recordAdmission(const Step& s, const Strikes* strikes) override {
        const auto& world = s.record.counts();
        s.record.commands().beginLabel("admission");
        const auto orAll = [](uint32_t room) { return room != 0 ? room : NO_INDEX; };
        const struct {
            uint32_t bodies, triangles, sites, fragments, seed, pairs, contacts;
            float duration, margin, pause;
            uint32_t kept_for_each, kept_for_whole;
        } admit = {room_.step_bodies,
                   room_.step_triangles,
                   room_.step_sites,
                   room_.most_fragments,
                   static_cast<uint32_t>(s.settings.breaking_seed),
                   orAll(room_.pairs),
                   orAll(room_.contacts),
                   static_cast<float>(s.settings.dt),
                   static_cast<float>(contactMargin(s.settings)),
                   kPause,
                   room_.kept_for_each,
                   room_.kept_for_whole};
        if (room_.radial) recordReach(s, strikes);
        if (strikes != nullptr)
            s.record.runGroups("admit_strikes", 1, admit,
                               {world, s.now.contacts, s.b.bodies, s.b.shapes, p_.blows, p_.chosen, l_.cards, s.b.steps,
                                l_.breakable, p_.breaking, p_.broken, event_.b.counts, event_.b.args, p_.reach_sums,
                                pools_.headers, strikes->records()});
        else
            s.record.runGroups("admit_breaking", 1, admit,
                               {world, s.now.contacts, s.b.bodies, s.b.shapes, p_.blows, p_.chosen, l_.cards, s.b.steps,
                                l_.breakable, p_.breaking, p_.broken, event_.b.counts, event_.b.args, p_.reach_sums,
                                pools_.headers});
        s.record.commands().endLabel();
    }

    Result<void> recordEvent(const Step& s) override {
        if (dust_) dust_->recordFlight(s);
        Recorder record(s.record.commands(), s.kernels, event_.b.counts, event_.b.args);
        recordBreaking(record, event_, p_.breaking, surfaces(), scene_->views(), colliders_->views());
        record.commands().beginLabel("rooms");
        recordRequests(record, s);
        recordTake(record, room_.pools, pools_, {COUNT_BREAKING, p_.sizes, p_.owner_start, p_.begins, p_.lacking},
                   s.many_lanes);
        record.run("give_rooms", Length::counted(COUNT_FRAGMENTS), engine::NoPush{},
                   {record.counts(), p_.order, p_.sizes, p_.begins, p_.rooms, s.b.steps, p_.owners, p_.cracks});
        recordPayment(record, s);
        if (s.has(Effect::Events)) recordTelling(s);
        record.commands().endLabel();
        recordSwap(record, s);
        if (debris_) debris_->record(s, worldOf(s), room_.pools, pools_, {l_.told, l_.ring});
        return record.status();
    }

    Result<Breaks> tell(uint32_t& heard) override { return hear<gpu::BreakEvent>(device_, l_.told, l_.ring, heard); }

    std::vector<BufferView> stateViews() const override {
        std::vector<BufferView> views = {l_.breakable, l_.surface_vertices, pools_.headers, pools_.free_ranges};
        if (effects_.has(Effect::Events)) views.insert(views.end(), {l_.told, l_.ring});
        if (dust_) std::ranges::copy(dust_->stateViews(), std::back_inserter(views));
        if (debris_) std::ranges::copy(debris_->stateViews(), std::back_inserter(views));
        return views;
    }
    std::vector<BufferView> stepMemory() const override {
        const ScenePools s = scene_->views();
        const ColliderPools c = colliders_->views();
        return {passing_->buffer(), s.vertices,  s.indices, s.draw_commands, s.objects,  s.matrices,
                s.bounds,           s.fragments, c.records, c.faces,         c.vertices, c.corners};
    }
    std::vector<NamedBuffer> buffers() const override {
        std::vector<NamedBuffer> named = namedBuffers(l_, p_, pools_);
        const BufferView range(&passing_->buffer(), fracture_begin_, passing_->capacity() - fracture_begin_);
        std::ranges::copy(namedBuffers(event_.b, {"fracture", range, range.size, Effect::ImpactFracture, true}),
                          std::back_inserter(named));
        std::ranges::copy(namedBuffers(scene_->views(), colliders_->views()), std::back_inserter(named));
        if (dust_) std::ranges::copy(dust_->named(), std::back_inserter(named));
        if (debris_) std::ranges::copy(debris_->named(), std::back_inserter(named));
        return named;
    }
    BufferView arguments() const override { return event_.b.args; }
    BufferView surfaceVertices() const override { return l_.surface_vertices; }
    BufferView breakable() const override { return l_.breakable; }
    std::optional<BufferView> clocks() const override { return debris_ ? std::optional(debris_->clocks()) : std::nullopt; }

    Result<Dust> dust() const override { return dust_ ? dust_->read() : Result<Dust>(Dust()); }
    Result<std::vector<float>> fades(uint32_t slots) const override {
        return debris_ ? debris_->fades(slots, settings_) : Result<std::vector<float>>(std::vector<float>(slots, 1.0f));
    }
    Result<std::array<gpu::PoolHeader, POOLS>> pools() const override {
        std::array<gpu::PoolHeader, POOLS> headers;
        const Fetch wanted[] = {{pools_.headers, headers.data(), sizeof headers}};
        if (auto read = fetch(device_, wanted); !read) return read.error();
        return headers;
    }

private:
    // What comes first to each body.
    void recordOrder(const Step& s) const {
        const auto& world = s.record.counts();
        const auto duration = static_cast<float>(s.settings.dt);
        s.record.run("drop_blows", Length::counted(COUNT_STRUCK), duration,
                     {world, s.now.pairs, s.now.contacts, s.b.bodies, s.b.shapes, l_.breakable, p_.blows, p_.soonest});
        s.record.run("rank_blows", Length::counted(COUNT_STRUCK), duration,
                     {world, s.now.contacts, s.b.bodies, l_.breakable, p_.soonest, p_.blows, p_.hardest});
    }

    SurfaceList surfaces() const {
        return {l_.surface_vertices, room_.surfaces.parts() > 1 ? room_.surfaces.part_triangles : 0};
    }
    uint32_t largestPart() const { return std::min(room_.surfaces.capacity, room_.surfaces.part_triangles); }

    // How far it is to the rim of what breaks in rays.
    void recordReach(const Step& s, const Strikes* strikes) const {
        for (const SurfacePart& part : surfaces().parts()) {
            const uint32_t push[] = {part.range.first, part.range.end, room_.step_triangles};
            const auto& world = s.record.counts();
            if (strikes != nullptr)
                s.record.runGroups("measure_reach_strikes", 1, push,
                                   {world, s.now.contacts, s.b.bodies, s.b.shapes, p_.blows, p_.chosen, l_.breakable,
                                    part.vertices, p_.reach_sums, strikes->records()});
            else
                s.record.runGroups("measure_reach", 1, push,
                                   {world, s.now.contacts, s.b.bodies, s.b.shapes, p_.blows, p_.chosen, l_.breakable,
                                    part.vertices, p_.reach_sums});
        }
    }

    // Who is asked for what, object by object.
    void recordRequests(Recorder& record, const Step& s) {
        const float least = leastVolumeOf(s.settings);
        const BufferView& fragments = scene_->views().fragments;
        const Length all = Length::counted(COUNT_FRAGMENTS);
        record.run("key_fragments", all, engine::NoPush{}, {record.counts(), fragments, event_.b.sites, p_.owners, p_.order});
        record.sort(COUNT_FRAGMENTS, kOwnerBits, {p_.owners, p_.other_owners}, {p_.order, p_.other_order},
                    {p_.histogram, p_.digit_offsets, p_.sums});
        record.runGroups("measure_cracks", record.groupsOf(COUNT_BREAKING), least,
                         {record.counts(), p_.breaking, p_.broken, l_.breakable, l_.cards, p_.owners, p_.order, fragments,
                          p_.cracks, p_.owner_start, p_.size_shares, s.b.bodies, s.b.shapes});
        record.run(
            "ask_rooms", all, least,
            {record.counts(), p_.owners, p_.order, fragments, colliders_->views().records, p_.cracks, p_.sizes, p_.breaking});
    }

    void recordPayment(Recorder& record, const Step& s) {
        const float push[] = {static_cast<float>(s.settings.dt), kPause};
        record.run("pay_cracks", Length::counted(COUNT_BREAKING), push,
                   {record.counts(), p_.broken, p_.cracks, p_.lacking, s.b.bodies, s.b.shapes, l_.breakable, l_.cards,
                    s.b.steps, p_.ledger});
    }

    // In every step: a body that no step has room for is told of where nothing breaks.
    void recordTelling(const Step& s) {
        s.record.runGroups("tell_breaks", 1, engine::NoPush{},
                           {event_.b.counts, p_.broken, p_.ledger, p_.owner_start, s.b.bodies, l_.breakable, s.b.steps, l_.told,
                            l_.ring, p_.lacking, p_.size_shares, l_.cards});
    }

    BreakableWorld worldOf(const Step& s) const {
        return {s.b.bodies, s.b.shapes, s.b.pieces, s.b.hulls(), l_.breakable, surfaces(), l_.cards, s.b.steps, s.b.births};
    }

    void recordSwap(Recorder& record, const Step& s) {
        const BrokenParts parts = {scene_->views().fragments,
                                   event_.b.sites,
                                   scene_->views().vertices,
                                   colliders_->views(),
                                   p_.breaking,
                                   p_.broken,
                                   p_.rooms};
        const BreakableWorld world = worldOf(s);
        const auto hold = s.has(Effect::Refracture) ? static_cast<float>(s.settings.blow_time) : kForEver;
        const FragmentSettings settings = {s.settings.breaking_seed, hold, static_cast<float>(s.settings.dt)};
        recordAdoption(record, parts, world, settings, p_.adopted);
        if (dust_)
            dust_->recordEmission(s, {parts, world, record.counts(), record.lanesOf(COUNT_FRAGMENTS), p_.order, p_.owners});
        recordRetirement(record, parts, world, p_.adopted, p_.returned);
        record.commands().beginLabel("returns");
        recordReturn(record, room_.pools, pools_, {COUNT_BREAKING, p_.returned}, s.many_lanes);
        record.commands().endLabel();
    }

    // Planned by taking all from arenas that are too small.
    Result<void> makeBuffers(const WorldContents& contents) {
        if (auto fits = canBind(uint64_t{event_.capacity.fragments} * sizeof(FragmentRecord), contents); !fits) return fits;
        auto scene = SceneBuffers::create(device_, event_.capacity.emitted, event_.capacity.fragments);
        if (!scene) return scene.error();
        scene_ = std::move(*scene);
        if (auto fits = canBind(scene_->views().vertices.size, contents); !fits) return fits;
        if (auto fits = canBind(uint64_t{largestPart()} * 3 * sizeof(FragmentVertex), contents); !fits) return fits;
        auto colliders = ColliderBuffers::create(device_, event_.capacity);
        if (!colliders) return colliders.error();
        colliders_.emplace(std::move(*colliders));
        auto plan = engine::ScratchArena::create(device_, 256, "plan"),
             other = engine::ScratchArena::create(device_, 256, "plan");
        if (!plan) return plan.error();
        if (!other) return other.error();
        if (auto laid_out = layOutAll(*plan, *other, contents); !laid_out) return laid_out;
        if (auto fits = canBind(std::max(plan->largest(), other->largest()), contents); !fits) return fits;
        auto lasting = engine::ScratchArena::create(device_, plan->peak(), "breaking", VK_BUFFER_USAGE_VERTEX_BUFFER_BIT),
             passing = engine::ScratchArena::create(device_, other->peak(), "breaking, in a step");
        if (!lasting) return lasting.error();
        if (!passing) return passing.error();
        lasting_.emplace(std::move(*lasting));
        passing_.emplace(std::move(*passing));
        if (auto done = layOutAll(*lasting_, *passing_, contents); !done) return done.error();
        if (auto fits = lasting_->status(); !fits) return fits;
        return passing_->status();
    }

    // For what is too small to be a body, or to stay.
    Result<void> makeSmall(const WorldContents& contents) {
        if (effects_.has(Effect::Dust)) {
            auto dust = DustRing::create(device_, contents, room_.particles, sizes_.fragments);
            if (!dust) return dust.error();
            dust_ = std::move(*dust);
        }
        if (!effects_.has(Effect::DebrisLifetime) && !effects_.has(Effect::DebrisRoom)) return {};
        const uint32_t half = room_.kept_for_whole;
        auto debris = Debris::create(device_, {sizes_.bodies, half / 4, half / 2, room_.kept_for_each, room_.whole}, effects_);
        if (!debris) return debris.error();
        debris_ = std::move(*debris);
        return {};
    }

    Result<void> layOutAll(engine::ScratchArena& lasting, engine::ScratchArena& passing, const WorldContents& contents) {
        l_ = layOutLasting(lasting, contents, effects_);
        p_ = layOutPassing(passing, sizes_);
        auto pools = layOutPools(lasting, passing, room_.pools);
        if (!pools) return pools.error();
        pools_ = *pools;
        fracture_begin_ = passing.used();
        layOutBreaking(passing, event_);
        return {};
    }

    Result<void> canBind(uint64_t bytes, const WorldContents& contents) const {
        const uint64_t most = device_.limits().maxStorageBufferRange;
        if (bytes <= most) return {};
        return Error{ErrorCode::Capacity,
                     "what breaks in a step needs a list of " + std::to_string(bytes) + " bytes, the device can bind " +
                         std::to_string(most) + "; the budgets are " + std::to_string(room_.step_triangles) +
                         " triangles and " + std::to_string(room_.step_sites) + " sites of all that breaks in a step, and " +
                         std::to_string(room_.surfaces.capacity) + " triangles of all surfaces; body \"" +
                         largestBody(contents) + "\" has the most triangles, " + std::to_string(largestSurface(contents)) +
                         ": lower the budgets, or simplify the body"};
    }

    Result<void> fill(const WorldContents& contents) {
        const auto pools = poolsWith(room_.pools, room_.free);
        if (!pools) return pools.error();
        Upload upload;
        upload.add(std::span(contents.breakable), l_.breakable);
        upload.add(std::span(contents.cards), l_.cards);
        upload.add(std::span(contents.surface_vertices), l_.surface_vertices);
        constexpr uint32_t kNothing[] = {0};
        if (effects_.has(Effect::Events)) upload.add(std::span<const uint32_t>(kNothing), l_.told);
        upload.add(std::span<const gpu::PoolHeader>(pools->headers), pools_.headers);
        upload.add(std::span(pools->ranges), pools_.free_ranges);
        return upload.send(device_);
    }

    Device& device_;
    RoomToBreak room_;
    StepSettings settings_;
    EffectSet effects_;
    BreakingSizes sizes_;
    BreakingEvent event_;
    std::optional<SceneBuffers> scene_;
    std::optional<ColliderBuffers> colliders_;
    std::optional<engine::ScratchArena> lasting_, passing_;
    LastingBuffers l_;
    PassingBuffers p_;
    PoolBuffers pools_;
    VkDeviceSize fracture_begin_ = 0; // of what fracturing needs, in what is made anew
    std::unique_ptr<DustRing> dust_;
    std::unique_ptr<Debris> debris_;
};

// The most triangles of a body that breaks.
Result<uint32_t> mostTriangles(Device& device, const BreakingBudget& budget) {
    uint32_t fits = 0, too_many = 1u << 24;
    while (too_many - fits > 1) {
        const uint32_t middle = fits + (too_many - fits) / 2;
        const auto list = largestListOf(device, roomInAStep(middle, budget));
        if (!list) return list.error();
        (*list <= device.limits().maxStorageBufferRange ? fits : too_many) = middle;
    }
    return fits;
}

} // namespace

Result<void> canBreak(Device& device, uint32_t triangles, const BreakingBudget& budget) {
    if (budget.step_triangles != 0) return {};
    const auto list = largestListOf(device, roomInAStep(triangles, budget));
    if (!list) return list.error();
    if (*list <= device.limits().maxStorageBufferRange) return {};
    const auto most = mostTriangles(device, budget);
    if (!most) return most.error();
    return Error{ErrorCode::Capacity,
                 "a surface of " + std::to_string(triangles) + " triangles: what breaks in a step needs a list of " +
                     std::to_string(*list) + " bytes, and the device can bind " +
                     std::to_string(device.limits().maxStorageBufferRange) + ", enough for " + std::to_string(*most) +
                     " triangles; simplify the body, or give it no material so that it does not break"};
}

Result<std::unique_ptr<Breaking>> Breaking::create(Device& device, const WorldContents& contents, const RoomToBreak& room,
                                                   const StepSettings& settings, const WorldSizes& world, uint32_t group_size) {
    auto breaking = std::make_unique<DeviceBreaking>(device, room, settings);
    const auto made = breaking->make(contents, world.pairs, group_size);
    if (!made && made.error().code == ErrorCode::Capacity)
        return Error{ErrorCode::Capacity,
                     "room for what breaks: " + made.error().message + "; use smaller budgets for breaking"};
    if (!made) return made.error();
    return std::unique_ptr<Breaking>(std::move(breaking));
}

} // namespace brittle
