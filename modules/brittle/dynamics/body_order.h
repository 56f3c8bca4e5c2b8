// The order in which a world keeps bodies: by their ids, so that what comes of them does not depend on the order in which they
// were added.
#pragma once

#include "modules/brittle/dynamics/world_contents.h"

namespace brittle {

// Where what the world has at a place was in the contents that it was made of.
struct BodyOrder {
    std::vector<uint32_t> body_at, piece_at;
};

// Bodies of the same id stay in the order in which they were added.
BodyOrder orderById(const WorldContents& contents);

WorldContents inOrder(const WorldContents& contents, const BodyOrder& order);

} // namespace brittle
