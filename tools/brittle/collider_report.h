// What brittle shatter says of colliders.
#pragma once

#include "modules/brittle/fracture/fragments.h"

#include <nlohmann/json.hpp>

namespace cli {

nlohmann::ordered_json collidersJson(const brittle::FragmentSet& fragments);
void printColliders(const brittle::FragmentSet& fragments);

} // namespace cli
