// How cut faces are triangulated.
#pragma once

#include <cstdint>

namespace brittle {

enum class Caps : uint8_t {
    Exact, // right for any solid
    Convex // as fans, the paper's way (section 5): right where the surface is convex, turned over in places where it is not
};

} // namespace brittle
