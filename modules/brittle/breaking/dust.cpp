#include "modules/brittle/breaking/dust.h"

#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/fracture/fetch.h"
#include "modules/brittle/fracture/upload.h"
#include "modules/brittle/mesh/vector_math.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

namespace brittle {
namespace {

using engine::Buffer;
using engine::BufferDomain;
using engine::BufferView;
using engine::Device;
using engine::Result;

constexpr float kViscosity = 1.789e-5f; // Pa s, of air at 15 degrees (U.S. Standard Atmosphere 1976)

std::vector<gpu::DustPlane> planesOf(const WorldContents& contents) {
    std::vector<gpu::DustPlane> planes;
    for (const gpu::PieceRecord& piece : contents.pieces) {
        if (piece.ids.y == NO_INDEX || (piece.ids.z & PIECE_PLANE) == 0) continue;
        const gpu::BodyState& body = contents.bodies[piece.ids.y];
        const Float3 up = toFloat(turnedBy({body.turn.x, body.turn.y, body.turn.z, body.turn.w}, {0, 1, 0}));
        planes.push_back({body.sector, body.offset, {up[0], up[1], up[2], 0}});
    }
    return planes;
}

double massAt(const std::vector<uint32_t>& state, uint32_t word) {
    return std::ldexp(state[word], -DUST_GRAIN_BITS) + std::ldexp(state[word + 1], 32 - DUST_GRAIN_BITS);
}

uint32_t stepsIn(double seconds, double dt) { return static_cast<uint32_t>(std::min(std::ceil(seconds / dt - 1e-6), 4e9)); }

} // namespace

DustAmount Dust::inTheAir() const {
    DustAmount sum = {flying.size(), 0};
    for (const gpu::DustParticle& particle : flying)
        sum.mass += double{particle.velocity.w};
    return sum;
}

Result<std::unique_ptr<DustRing>> DustRing::create(Device& device, const WorldContents& contents, uint32_t particles,
                                                   uint32_t fragments) {
    const uint64_t bytes = std::bit_ceil(uint64_t{particles}) * sizeof(gpu::DustParticle),
                   most = device.limits().maxStorageBufferRange;
    if (bytes > most)
        return engine::Error{engine::ErrorCode::Capacity, "a budget of " + std::to_string(particles) +
                                                              " particles of dust, the device has room for " +
                                                              std::to_string(most / sizeof(gpu::DustParticle))};
    std::unique_ptr<DustRing> ring(new DustRing(device));
    ring->capacity_ = std::bit_ceil(particles);
    if (auto made = ring->make(planesOf(contents), fragments); !made) return made.error();
    return ring;
}

Result<void> DustRing::make(const std::vector<gpu::DustPlane>& planes, uint32_t fragments) {
    plane_count_ = static_cast<uint32_t>(planes.size());
    struct Wanted {
        Buffer& buffer;
        uint64_t bytes;
        const char* name;
    } const wanted[] = {{state_, 4 * DUST_WORDS, "dust"},
                        {ring_, capacity_ * sizeof(gpu::DustParticle), "dust particles"},
                        {planes_, std::max<uint64_t>(plane_count_, 1) * sizeof(gpu::DustPlane), "dust planes"},
                        {offsets_, 4ull * std::max(fragments, 1u), "dust offsets"}};
    for (const auto& [buffer, bytes, name] : wanted) {
        auto made = Buffer::create(device_, bytes, BufferDomain::Device, 0, name);
        if (!made) return made.error();
        buffer = std::move(*made);
    }
    const std::vector<uint32_t> nothing(DUST_WORDS);
    const std::vector<gpu::DustParticle> empty(capacity_);
    Upload upload;
    upload.add(std::span(nothing), state_);
    upload.add(std::span(empty), ring_);
    upload.add(std::span(planes), planes_);
    return upload.send(device_);
}

void DustRing::recordFlight(const Step& s) const {
    const gpu::vec4 falling = fallingOf(s);
    struct Push {
        float gravity[4], density, viscosity;
        uint32_t lifetime, plane_count, capacity;
    } push = {{falling.x, falling.y, falling.z, falling.w},
              static_cast<float>(s.settings.air_density),
              kViscosity,
              stepsIn(s.settings.dust_lifetime, s.settings.dt),
              plane_count_,
              capacity_};
    const BufferView arguments = BufferView(state_).sub(4 * DUST_ARGUMENTS, 12);
    s.record.commands().beginLabel("dust");
    s.record.runGroups("step_dust", arguments, push, {s.record.counts(), s.b.steps, planes_, state_, ring_});
    s.record.commands().endLabel();
}

// The ring goes on in every step, so this hangs on no event.
void DustRing::recordEmission(const Step& s, const Event& e) const {
    const BrokenParts& parts = e.parts;
    struct Push {
        float least_volume;
        uint32_t capacity;
    } allot = {leastVolumeOf(s.settings), capacity_};
    struct EmitPush {
        float least_volume;
        uint32_t capacity, seed;
    } emit = {allot.least_volume, capacity_, static_cast<uint32_t>(s.settings.breaking_seed)};
    s.record.commands().beginLabel("new dust");
    s.record.runGroups("allot_dust", 1, allot,
                       {e.counts, e.order, e.owners, parts.fragments, parts.breaking, parts.rooms, state_, offsets_});
    s.record.runGroups("emit_dust", e.lanes, emit,
                       {e.counts, e.order, parts.fragments, parts.sites, parts.colliders.records, parts.colliders.faces,
                        parts.breaking, parts.broken, parts.rooms, e.world.bodies, e.world.breakable, e.world.steps, offsets_,
                        state_, ring_, e.world.cards});
    s.record.commands().endLabel();
}

Result<Dust> DustRing::read() const {
    std::vector<uint32_t> state(DUST_WORDS);
    const Fetch words[] = {{state_, state.data(), 4 * state.size()}};
    if (auto read = fetch(device_, words); !read) return read.error();
    Dust dust;
    dust.made = {state[DUST_NEXT], massAt(state, DUST_MADE_MASS)};
    dust.settled = {state[DUST_SETTLED] + state[DUST_AGED], massAt(state, DUST_SETTLED_MASS)};
    dust.overwritten = {state[DUST_OVERWRITTEN], massAt(state, DUST_OVERWRITTEN_MASS)};
    const uint32_t first = state[DUST_FIRST] + state[DUST_AGED], flying = state[DUST_NEXT] - first;
    if (flying == 0) return dust;
    std::vector<gpu::DustParticle> ring(capacity_);
    const Fetch particles[] = {{ring_, ring.data(), ring.size() * sizeof(gpu::DustParticle)}};
    if (auto read = fetch(device_, particles); !read) return read.error();
    for (uint32_t k = 0; k < flying; ++k)
        dust.flying.push_back(ring[(first + k) % capacity_]);
    return dust;
}

std::vector<NamedBuffer> DustRing::named() const {
    return {{"dust", state_, state_.size(), Effect::Dust},
            {"dust particles", ring_, ring_.size(), Effect::Dust},
            {"dust planes", planes_, planes_.size(), Effect::Dust},
            {"dust offsets", offsets_, offsets_.size(), Effect::Dust}};
}

} // namespace brittle
