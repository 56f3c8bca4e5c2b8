#include "modules/brittle/breaking/strikes.h"

#include "modules/brittle/dynamics/sector_place.h"

#include <array>
#include <cmath>

namespace brittle {
namespace {

using engine::Buffer;
using engine::BufferDomain;
using engine::Error;
using engine::ErrorCode;
using engine::Result;

constexpr double kFarthest = 1e6, kWidest = 1e6, kHardest = 1e15; // m, m, J
constexpr Length kBodies = {0, COUNT_BODIES}, kPieces = {0, COUNT_BOXES};

gpu::Strike strikeOf(const HandBlow& blow) {
    const SectorPlace place = inSectors(blow.place);
    return {place.sector,
            {place.offset[0], place.offset[1], place.offset[2], static_cast<float>(blow.radius)},
            {static_cast<float>(blow.energy), 0, 0, 0}};
}

} // namespace

Result<void> checkBlow(const HandBlow& blow) {
    for (const double x : blow.place)
        if (!(std::abs(x) <= kFarthest))
            return Error{ErrorCode::BadInput, "a blow's place has to be numbers, and no further out than 1e6 m"};
    if (!(blow.radius > 0 && blow.radius <= kWidest))
        return Error{ErrorCode::BadInput, "a blow's radius has to be above 0 and at most 1e6 m"};
    if (!(blow.energy > 0 && blow.energy <= kHardest))
        return Error{ErrorCode::BadInput, "a blow's energy has to be above 0 and at most 1e15 J"};
    return {};
}

Result<std::unique_ptr<Strikes>> Strikes::create(engine::Device& device, uint32_t bodies, uint32_t pieces) {
    std::unique_ptr<Strikes> strikes(new Strikes(device));
    if (auto made = strikes->make(bodies, pieces); !made) return made.error();
    return strikes;
}

Result<void> Strikes::make(uint64_t bodies, uint64_t pieces) {
    struct Wanted {
        Buffer& buffer;
        uint64_t bytes;
        const char* name;
    } const wanted[] = {{strikes_, MOST_STRIKES * sizeof(gpu::Strike), "strikes"},
                        {distances_, 4 * MOST_STRIKES * pieces, "distances of strikes"},
                        {nearest_, 4 * MOST_STRIKES * bodies, "nearest to strikes"},
                        {claims_, 4 * MOST_STRIKES * bodies, "pieces struck"},
                        {reached_, 4 * MOST_STRIKES, "reached by strikes"},
                        {records_, bodies * sizeof(gpu::StrikeRecord), "bodies struck"}};
    for (const auto& [buffer, bytes, name] : wanted) {
        if (bytes > device_.limits().maxStorageBufferRange)
            return Error{ErrorCode::Capacity, "striking by hand needs a list of " + std::to_string(bytes >> 20) +
                                                  " MiB, more than the device can bind; use smaller budgets for breaking"};
        auto made = Buffer::create(device_, bytes, BufferDomain::Device, 0, name);
        if (!made) return made.error();
        buffer = std::move(*made);
    }
    return {};
}

void Strikes::recordJudging(const Step& s, const LastingBuffers& l, const HandBlows& by_hand) const {
    const std::vector<HandBlow>& blows = by_hand.blows;
    ENGINE_ASSERT(blows.size() <= MOST_STRIKES);
    std::array<gpu::Strike, MOST_STRIKES> strikes = {};
    for (size_t k = 0; k < blows.size(); ++k)
        strikes[k] = strikeOf(blows[k]);
    engine::Commands& commands = s.record.commands();
    const auto count = static_cast<uint32_t>(blows.size());
    const struct {
        uint32_t count;
        float duration;
    } push = {count, static_cast<float>(s.settings.dt)};
    const auto& counts = s.record.counts();
    commands.beginLabel("strikes");
    if (by_hand.is_first) commands.fill(records_, 0);
    commands.update(strikes_, std::as_bytes(std::span(strikes)));
    commands.fill(nearest_, NO_INDEX);
    commands.fill(claims_, NO_INDEX);
    commands.fill(reached_, 0);
    s.record.run("measure_strikes", kPieces, count,
                 {counts, s.b.bodies, s.b.pieces, s.b.hull_records, s.b.hull_vertices, s.b.hull_faces, s.b.hull_corners,
                  l.breakable, strikes_, distances_, nearest_});
    s.record.run("claim_strikes", kPieces, count, {counts, s.b.pieces, distances_, nearest_, claims_});
    s.record.run("count_strikes", kBodies, push, {counts, l.breakable, s.b.steps, claims_, reached_});
    s.record.run("judge_strikes", kBodies, push,
                 {counts, s.b.bodies, s.b.shapes, s.b.pieces, s.b.hull_records, s.b.hull_vertices, s.b.hull_faces,
                  s.b.hull_corners, l.breakable, l.cards, s.b.steps, strikes_, claims_, reached_, records_});
    s.record.run("wake_struck", Length::counted(COUNT_BOX_PAIRS), engine::NoPush{},
                 {counts, s.now.contacts, records_, s.b.bodies});
    commands.endLabel();
}

void Strikes::recordRaising(const Step& s, const LastingBuffers& l, const PassingBuffers& p) const {
    s.record.run("raise_strikes", kBodies, engine::NoPush{}, {s.record.counts(), records_, p.hardest, l.breakable, s.b.bodies});
}

void Strikes::recordChoice(const Step& s, const PassingBuffers& p) const {
    s.record.run("choose_strikes", kBodies, engine::NoPush{}, {s.record.counts(), records_, p.hardest, p.chosen});
}

Result<void> Strikes::forget() {
    engine::Commands commands(device_);
    if (auto begun = commands.begin(); !begun) return begun;
    commands.fill(records_, 0);
    return commands.submitAndWait();
}

} // namespace brittle
