// Bodies for worlds in tests.
#pragma once

#include "modules/brittle/dynamics/world_contents.h"

namespace support {

// Edges along the axes; size in meters, density in kg/m3.
brittle::PieceShape boxPiece(const brittle::Double3& size);
brittle::BodyDefinition box(const brittle::Double3& size, const brittle::Double3& place, double density = 1000);
// A box that does not move and whose upper side is y = 0.
brittle::BodyDefinition ground(double edge = 200);

} // namespace support
