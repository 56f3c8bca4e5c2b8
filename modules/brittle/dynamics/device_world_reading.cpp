// What a world tells of its bodies: read back from the device, in the order in which they were added.
#include "modules/brittle/dynamics/device_world.h"

#include "modules/brittle/fracture/fetch.h"

#include <algorithm>

namespace brittle {

using engine::Result;

namespace {

// By the numbers that bodies were added with.
template <typename Told, typename Number>
void nameAsAdded(Told& told, const Number& bodyAsAdded) {
    for (auto& event : told.events)
        for (uint32_t* body : {&event.what.y, &event.what.z, &event.born.z, &event.born.w})
            *body = bodyAsAdded(*body);
}

} // namespace

Result<std::vector<gpu::BodyState>> DeviceWorld::bodies() {
    if (auto settled = settle(); !settled) return settled.error();
    auto states = readStates();
    if (!states) return states;
    std::vector<gpu::BodyState> as_added = *states;
    for (size_t k = 0; k < order_.body_at.size(); k++)
        as_added[order_.body_at[k]] = (*states)[k];
    return as_added;
}

Result<std::vector<BodyFragment>> DeviceWorld::fragments() {
    if (auto settled = settle(); !settled) return settled.error();
    if (!breaking_) return std::vector<BodyFragment>();
    auto read = fragments_.read(device_, breaking_->breakable(), b_.births, slots_, broken_ + expired_);
    if (!read) return read;
    const auto fades = breaking_->fades(slots_);
    if (!fades) return fades.error();
    for (BodyFragment& fragment : *read) {
        fragment.fade = (*fades)[fragment.slot];
        fragment.slot = bodyAsAdded(fragment.slot);
        fragment.origin = bodyAsAdded(fragment.origin);
        fragment.parent = bodyAsAdded(fragment.parent);
    }
    return read;
}

Result<std::vector<SurfaceMesh>> DeviceWorld::surfacesOf(std::span<const BodyFragment> fragments) {
    if (fragments.empty()) return std::vector<SurfaceMesh>();
    return readSurfaces(device_, breaking_->surfaceVertices(), fragments);
}

Result<WorldCounts> DeviceWorld::counts() {
    if (auto settled = settle(); !settled) return settled.error();
    std::vector<uint32_t> words(STATUS_WORDS), args(9 * COUNT_TOTAL), colors(COLOR_WORDS);
    std::vector<Fetch> wanted = {{b_.counts, words.data(), 4 * words.size()}, {b_.args, args.data(), 4 * args.size()}};
    if (has(Effect::Contacts)) wanted.push_back({b_.step.color_start, colors.data(), 4 * colors.size()});
    std::vector<uint32_t> breaking_args(breaking_ ? 9 * COUNT_TOTAL : 0);
    if (breaking_) wanted.push_back({breaking_->arguments(), breaking_args.data(), 4 * breaking_args.size()});
    if (auto read = fetch(device_, wanted); !read) return read.error();
    WorldCounts c = {slots_, b_.sizes.pieces, words[COUNT_BOX_PAIRS], words[COUNT_CONTACTS], words[COUNT_FRESH_PAIRS]};
    for (uint32_t k = COUNT_BOX_PAIRS; k <= COUNT_SOLVED_APART; k++)
        c.groups += args[9 * k] * args[9 * k + 1];
    for (size_t k = 0; k < breaking_args.size(); k += 9)
        c.breaking_groups += breaking_args[k] * breaking_args[k + 1];
    c.colors = words[COUNT_CONTACTS] == 0 ? 0 : colors[COLORS_USED];
    c.awake = has(Effect::Sleeping) ? words[COUNT_AWAKE] : b_.movers + fragments_made_ - broken_ - expired_;
    c.colorless = words[COUNT_CONTACTS] == 0 ? 0 : colors[COLORS_LACKED];
    c.broken = broken_;
    c.fragments = fragments_made_;
    c.expired = expired_;
    if (auto counted = countPools(c); !counted) return counted.error();
    return c;
}

Result<Dust> DeviceWorld::dust() {
    if (auto settled = settle(); !settled) return settled.error();
    if (!breaking_) return Dust();
    auto dust = breaking_->dust();
    if (!dust) return dust;
    for (gpu::DustParticle& particle : dust->flying)
        particle.birth.y = bodyAsAdded(particle.birth.y);
    return dust;
}

Result<Breaks> DeviceWorld::breaks() {
    if (auto settled = settle(); !settled) return settled.error();
    if (!breaking_ || !has(Effect::Events)) return Breaks();
    auto told = breaking_->tell(heard_.breaks);
    if (!told) return told.error();
    nameAsAdded(*told, [this](uint32_t slot) { return bodyAsAdded(slot); });
    return told;
}

Result<Impacts> DeviceWorld::impacts() {
    if (auto settled = settle(); !settled) return settled.error();
    if (!has(Effect::Contacts) || !has(Effect::Events)) return Impacts();
    auto told = hear<gpu::ImpactEvent>(device_, b_.impacts_told, b_.impacts, heard_.impacts);
    if (!told) return told.error();
    nameAsAdded(*told, [this](uint32_t slot) { return bodyAsAdded(slot); });
    return told;
}

Result<std::vector<std::array<uint32_t, 2>>> DeviceWorld::pairs() {
    auto counted = counts();
    if (!counted) return counted.error();
    std::vector<std::array<uint32_t, 2>> pairs(counted->pairs);
    if (pairs.empty()) return pairs;
    const Fetch wanted[] = {{b_.memory[(made_ + 1) & 1].pairs.sub(0, 8 * pairs.size()), pairs.data(), 8 * pairs.size()}};
    if (auto read = fetch(device_, wanted); !read) return read.error();
    for (auto& pair : pairs) {
        const uint32_t a = pieceAsAdded(pair[0]), b = pieceAsAdded(pair[1]);
        pair = {std::min(a, b), std::max(a, b)};
    }
    std::ranges::sort(pairs);
    return pairs;
}

Result<uint64_t> DeviceWorld::hash() {
    if (auto settled = settle(); !settled) return settled.error();
    const auto states = readStates();
    if (!states) return states.error();
    return hashOf(std::as_bytes(std::span(*states)));
}

Result<void> DeviceWorld::countPools(WorldCounts& c) {
    if (!breaking_) return {};
    const auto pools = breaking_->pools();
    if (!pools) return pools.error();
    for (size_t k = 0; k < pools->size(); k++) {
        c.in_use[k] = (*pools)[k].in_use;
        c.pool_faults |= (*pools)[k].status;
    }
    return {};
}

Result<std::vector<gpu::BodyState>> DeviceWorld::readStates() {
    std::vector<gpu::BodyState> states(slots_);
    const Fetch wanted[] = {{b_.bodies, states.data(), states.size() * sizeof(gpu::BodyState)}};
    if (auto read = fetch(device_, wanted); !read) return read.error();
    return states;
}

} // namespace brittle
