#include "modules/brittle/breaking/debris.h"

#include "modules/brittle/fracture/fetch.h"
#include "modules/brittle/fracture/upload.h"

#include <algorithm>

namespace brittle {
namespace {

using engine::Buffer;
using engine::BufferDomain;
using engine::BufferView;
using engine::Result;

constexpr double kRest = 0.5; // s, after which a fragment may make room

} // namespace

Result<std::unique_ptr<Debris>> Debris::create(engine::Device& device, const DebrisRoom& room, EffectSet effects) {
    std::unique_ptr<Debris> debris(new Debris(device, room, effects));
    if (auto made = debris->make(); !made) return made.error();
    return debris;
}

Result<void> Debris::make() {
    struct Wanted {
        Buffer& buffer;
        uint64_t bytes;
        const char* name;
    } const wanted[] = {{clocks_, room_.bodies * sizeof(gpu::DebrisClock), "debris clocks"},
                        {words_, 4 * DEBRIS_WORDS, "debris"},
                        {leaving_, 4 * MOST_EXPIRING, "debris that goes"},
                        {returned_, MOST_EXPIRING * sizeof(gpu::PoolShare), "ranges of debris"}};
    for (const auto& [buffer, bytes, name] : wanted) {
        auto made = Buffer::create(device_, bytes, BufferDomain::Device, 0, name);
        if (!made) return made.error();
        buffer = std::move(*made);
    }
    const std::vector<gpu::DebrisClock> clocks(room_.bodies);
    Upload upload;
    upload.add(std::span(clocks), clocks_);
    return upload.send(device_);
}

void Debris::recordAging(const Step& s, const BreakableWorld& world) const {
    const StepSettings& set = s.settings;
    const double below = s.has(Effect::DebrisLifetime) ? set.debris_below : 0;
    const float push[] = {static_cast<float>(set.dt), static_cast<float>(set.sleep_speed),
                          static_cast<float>(below * below * below), static_cast<float>(set.debris_after),
                          static_cast<float>(set.debris_fade)};
    s.record.clear({words_});
    s.record.run("age_debris", Length::counted(COUNT_BODIES), push,
                 {s.record.counts(), world.bodies, world.breakable, world.steps, clocks_, words_});
}

void Debris::recordLeaving(const Step& s, const BreakableWorld& world, const PoolBuffers& pools) const {
    struct Push {
        uint32_t least_room, enough_room;
        float rest;
        uint32_t kept_for_each, most_whole;
    } push = {room_.least_fragments, room_.enough_fragments,
              static_cast<float>(std::clamp(s.settings.debris_after, 1e-3, kRest)), room_.kept_for_each, room_.most_whole};
    if (s.has(Effect::DebrisRoom))
        s.record.runGroups("make_room", 1, push,
                           {s.record.counts(), world.breakable, world.steps, pools.headers, clocks_, words_});
    s.record.runGroups("list_debris", argumentsAt(DEBRIS_LIST_ARGUMENTS), engine::NoPush{},
                       {s.record.counts(), s.record.args(), clocks_, words_, leaving_});
}

void Debris::record(const Step& s, const BreakableWorld& world, const PoolRoom& room, const PoolBuffers& pools,
                    const BreakEvents& events) const {
    s.record.commands().beginLabel("debris");
    recordAging(s, world);
    recordLeaving(s, world, pools);
    if (s.has(Effect::Events))
        s.record.runGroups("tell_gone", argumentsAt(DEBRIS_TELL_ARGUMENTS), engine::NoPush{},
                           {words_, leaving_, world.bodies, world.breakable, world.steps, events.told, events.ring});
    if (s.has(Effect::Sleeping))
        s.record.runGroups("wake_debris", argumentsAt(DEBRIS_PAIR_ARGUMENTS), engine::NoPush{},
                           {s.record.counts(), s.now.contacts, clocks_, world.bodies});
    s.record.runGroups("expire_debris", argumentsAt(DEBRIS_GO_ARGUMENTS), engine::NoPush{},
                       {words_, leaving_, world.shapes, world.hulls.records, world.bodies, world.breakable, world.pieces,
                        clocks_, returned_, world.steps});
    Recorder ranges(s.record.commands(), s.kernels, words_, s.record.args());
    recordReturn(ranges, room, pools, {DEBRIS_LISTED, returned_, argumentsAt(DEBRIS_RETURN_ARGUMENTS)}, s.many_lanes);
    s.record.commands().endLabel();
}

Result<std::vector<float>> Debris::fades(uint32_t slots, const StepSettings& settings) const {
    std::vector<gpu::DebrisClock> clocks(slots);
    const Fetch wanted[] = {{clocks_, clocks.data(), clocks.size() * sizeof(gpu::DebrisClock)}};
    if (auto read = fetch(device_, wanted); !read) return read.error();
    std::vector<float> fades;
    for (const gpu::DebrisClock& clock : clocks) {
        const double over = double{clock.offset.w} - settings.debris_after;
        fades.push_back(over <= 0 ? 1.0f : static_cast<float>(std::max(0.0, 1 - over / std::max(settings.debris_fade, 1e-6))));
    }
    return fades;
}

std::vector<NamedBuffer> Debris::named() const {
    const auto named = [this](const char* name, const Buffer& buffer) {
        return NamedBuffer{name, buffer, buffer.size(), asked_by_};
    };
    return {named("debris clocks", clocks_), named("debris", words_), named("debris that goes", leaving_),
            named("ranges of debris", returned_)};
}

} // namespace brittle
