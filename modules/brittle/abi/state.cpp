#include "modules/brittle/abi/boundary.h"
#include "modules/brittle/dynamics/world_state.h"

#include <cstring>

namespace {

using namespace brittle::abi;

// In front of what a world saves, so that nothing else gets to the device.
struct Head {
    char magic[8] = {'B', 'R', 'I', 'T', 'T', 'L', 'E', '1'};
    uint64_t bodies = 0, colliders = 0, bytes = 0, hash = 0;
};

Head headFor(const HostedWorld& world, std::span<const std::byte> state) {
    Head head;
    head.bodies = world.scene.bodies.size();
    head.colliders = world.scene.colliders.size();
    head.bytes = state.size();
    head.hash = brittle::hashOf(state);
    return head;
}

std::vector<std::byte> save(HostedWorld& world) {
    const auto state = orRefuse(world.running().save());
    const Head head = headFor(world, state);
    std::vector<std::byte> bytes(sizeof head + state.size());
    std::memcpy(bytes.data(), &head, sizeof head);
    std::memcpy(bytes.data() + sizeof head, state.data(), state.size());
    return bytes;
}

std::span<const std::byte> stateIn(const HostedWorld& world, std::span<const std::byte> bytes) {
    if (bytes.size() < sizeof(Head)) throw Refusal(BRITTLE_BAD_STATE, "too few bytes for a saved state");
    Head told;
    std::memcpy(&told, bytes.data(), sizeof told);
    const auto state = bytes.subspan(sizeof(Head));
    if (told.bytes != state.size()) // no byte more is read
        throw Refusal(BRITTLE_BAD_STATE, "the state has " + std::to_string(told.bytes) + " bytes behind its head, not " +
                                             std::to_string(state.size()));
    const Head head = headFor(world, state);
    if (std::memcmp(&head, &told, sizeof head) != 0)
        throw Refusal(BRITTLE_BAD_STATE, "these bytes are no state of such a world, or have been changed since it was saved");
    return state;
}

} // namespace

BrittleResult brittleSaveState(BrittleContext* context, BrittleWorld world, void* bytes, size_t capacity, size_t* size) {
    return bounded(context, [&](BrittleContext& c) {
        HostedWorld& w = c.worlds.at(world.id);
        size_t& needs = needed(size, "size");
        static_cast<void>(w.running());
        if (!w.saved) w.saved = save(w);
        needs = w.saved->size();
        if (bytes == nullptr) return;
        if (capacity < needs)
            throw Refusal(BRITTLE_BUFFER_TOO_SMALL,
                          "the state has " + std::to_string(needs) + " bytes, there is room for " + std::to_string(capacity));
        std::memcpy(bytes, w.saved->data(), needs);
        w.saved.reset();
    });
}

BrittleResult brittleRestoreState(BrittleContext* context, BrittleWorld world, const void* bytes, size_t size) {
    return bounded(context, [&](BrittleContext& c) {
        HostedWorld& w = c.worlds.at(world.id);
        brittle::World& running = w.running();
        needed(static_cast<const std::byte*>(bytes), "bytes");
        w.saved.reset();
        const auto state = stateIn(w, {static_cast<const std::byte*>(bytes), size});
        w.countLost();
        orRefuse(running.restore(state), BRITTLE_BAD_STATE);
        w.forgetEvents();
    });
}

BrittleResult brittleHashState(BrittleContext* context, BrittleWorld world, uint64_t* hash) {
    return bounded(context, [&](BrittleContext& c) {
        HostedWorld& w = c.worlds.at(world.id);
        uint64_t& out = needed(hash, "hash");
        out = orRefuse(w.running().hash());
    });
}
