// What scenes say of their keys, said of the fields that a host has set instead.
#pragma once

#include "modules/brittle/abi/refusal.h"

namespace brittle::abi {

// The message with the names of fields of brittle.h for those of keys of a scene file.
std::string inFieldNames(std::string message);

// Refuses what a check of scenes refuses.
inline void orRefuseFields(const engine::Result<void>& checked) {
    if (!checked) throw Refusal(codeOf(checked.error().code, BRITTLE_BAD_VALUE), inFieldNames(checked.error().message));
}

} // namespace brittle::abi
