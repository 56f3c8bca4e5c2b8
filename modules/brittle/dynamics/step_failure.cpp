#include "modules/brittle/dynamics/step_failure.h"

#include "shaders-spirv/shared/fracture.h"

#include <string>

namespace brittle {

using engine::Error;
using engine::ErrorCode;

engine::Result<void> failureOf(std::span<const uint32_t> words, const WorldSizes& room, const TriedStep& step) {
    if (words[STATUS_FAILED] == 0) return {};
    const std::string which = "step " + std::to_string(step.number);
    if (const uint32_t pairs = words[STATUS_NEEDED + COUNT_BOX_PAIRS]; pairs > room.pairs)
        return Error{ErrorCode::Capacity,
                     which + " finds " + std::to_string(pairs) + " pairs of pieces near each other, there is room for " +
                         std::to_string(room.pairs) +
                         (step.has_pair_budget ? "; raise the budget of pairs"
                                               : ", the most of this device; use fewer pieces or spread them out")};
    if (const uint32_t contacts = words[STATUS_NEEDED + COUNT_CONTACTS]; contacts > room.contacts)
        return Error{ErrorCode::Capacity, which + " finds " + std::to_string(contacts) + " contacts, there is room for " +
                                              std::to_string(room.contacts) + "; raise the budget of contacts"};
    return Error{ErrorCode::Capacity, "in " + which +
                                          " a piece is near more than some ten thousand others, which no lane can walk" +
                                          " through; use coarser meshes, or smaller bodies"};
}

} // namespace brittle
