#include "modules/brittle/dynamics/world.h"

#include "modules/brittle/dynamics/device_world.h"
#include "modules/brittle/fracture/group_size.h"

#include <algorithm>

namespace brittle {
namespace {

using engine::Error;
using engine::ErrorCode;
using engine::Result;

constexpr uint32_t kPairsPerPiece = 9, kLeastPairs = 1024; // as piles have them; there is more room made where it is needed

// Where bodies of theirs may break, gives the contents slots for what they break into; else nothing.
Result<std::optional<RoomToBreak>> makeRoomToBreak(WorldContents& contents, const StepSettings& settings,
                                                   const WorldBudget& budget) {
    if (!effectsOf(settings).has(Effect::ImpactFracture) || contents.breakable.empty()) return std::optional<RoomToBreak>();
    auto room = roomToBreak(contents, budget.breaking);
    if (!room) return room.error();
    room->pairs = budget.pairs;
    room->contacts = budget.contacts != 0 ? budget.contacts : budget.pairs;
    contents = withRoom(contents, *room);
    return std::optional(std::move(*room));
}

} // namespace

Result<std::unique_ptr<World>> World::create(engine::Device& device, const WorldContents& contents,
                                             const StepSettings& settings, const WorldBudget& budget) {
    if (auto sound = checkSettings(settings); !sound) return sound.error();
    const uint32_t group_size = budget.group_size == 0 ? GROUP_SIZE : budget.group_size;
    if (auto sound = checkGroupSize(group_size, device.limits()); !sound) return sound.error();
    if (contents.bodies.empty()) return Error{ErrorCode::BadInput, "a world without bodies; add at least one"};
    BodyOrder order = orderById(contents);
    WorldContents sorted = inOrder(contents, order);
    const auto to_break = makeRoomToBreak(sorted, settings, budget);
    if (!to_break) return to_break.error();
    const uint64_t chosen =
        std::max<uint64_t>({kLeastPairs, uint64_t{kPairsPerPiece} * sorted.pieces.size(), 2 * sorted.siblings.size()});
    const auto room = budget.pairs != 0 ? budget.pairs : static_cast<uint32_t>(std::min<uint64_t>(chosen, mostPairs(device)));
    auto buffers = makeWorldBuffers(device, sorted, room, budget.contacts, effectsOf(settings));
    if (!buffers) return buffers.error();
    WorldBudget given = budget;
    given.group_size = group_size;
    auto world =
        std::make_unique<DeviceWorld>(device, std::move(order), std::move(sorted), std::move(*buffers), settings, given);
    if (*to_break)
        if (auto made = world->makeBreakable(**to_break); !made) return made.error();
    if (auto recorded = world->record(); !recorded) return recorded.error();
    return std::unique_ptr<World>(std::move(world));
}

} // namespace brittle
