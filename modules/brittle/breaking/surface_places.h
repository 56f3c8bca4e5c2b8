// Where surfaces lie in the list of a world that takes more than one part (surface_list.h).
//
// The last triangle of every part but the last is never used. So free ranges of two parts never touch, and what the device
// takes from the pool never lies in two parts.
#pragma once

#include "modules/brittle/breaking/world_pools.h"
#include "modules/brittle/dynamics/world_contents.h"

#include <unordered_map>
#include <vector>

namespace brittle {

// Triangles that fit in 128 MiB, which every device can bind at once. Parts begin at multiples of eight, so that views of
// them are aligned (engine::kViewAlignment).
constexpr uint32_t kUsualPart = 1'390'000;
constexpr uint32_t kPartsMultiple = 8;

struct SurfacePlaces {
    uint32_t part_triangles = 0;
    uint32_t capacity = 0; // triangles of the whole list
    uint32_t parts() const { return (std::max(capacity, 1u) - 1) / part_triangles + 1; }
    std::unordered_map<uint32_t, uint32_t> moved; // first triangle in the contents, and in the list
    std::vector<FreeRange> free;                  // in order, none touching
};

// Places all surfaces of the contents, in their order, and leaves at least `room` triangles free behind them. A part has
// `part_triangles`, or more if a surface needs it. Surfaces that fit in one part stay where they are.
SurfacePlaces placeSurfaces(const WorldContents& contents, uint32_t room, uint32_t part_triangles = kUsualPart);

// Moves the surfaces there. What is free is filled with zeros.
void moveSurfaces(WorldContents& contents, const SurfacePlaces& places);

} // namespace brittle
