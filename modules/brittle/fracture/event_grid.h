// The integer frame of one fracture event: a 24-bit grid around mesh and sites, the box that cells start from, and bins for
// the neighbor search.
#pragma once

#include "engine/result.h"
#include "modules/brittle/mesh/mesh.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace brittle {

using Int3 = std::array<int32_t, 3>;
using Int4 = std::array<int32_t, 4>;

struct EventGrid {
    float scale = 1;              // grid steps per model unit, a power of two: snapping rounds only once
    float step = 1;               // its inverse
    Int3 mesh_low{}, mesh_high{}; // of the mesh on the grid
    Int3 box_low{}, box_high{};   // mesh and sites never touch it
    Int4 bins{};                  // per axis; [3]: edge of a bin in grid steps
    uint32_t fullest_bin = 0;     // of given sites
    uint32_t tiles = 1;           // of objects that are broken together (fracture/batch.h), each with its own bins
    double solid_volume = 0;      // of the mesh, cubed grid steps
    // Measures are taken in units of half the grid's edge, where a model of any size is at most 1 from the center.
    float unit() const { return scale * kStep; }
    static constexpr float kStep = 0x1p-23f; // of the grid, in these units
    uint32_t binCount() const {
        return tiles * static_cast<uint32_t>(bins[0]) * static_cast<uint32_t>(bins[1]) * static_cast<uint32_t>(bins[2]);
    }
};

// Grid coordinates of mesh and sites run from 0 to 2^24, both included; the mesh's center lies at 2^23.
constexpr int32_t kGridCenter = 1 << 23;
// Nothing comes nearer to a wall of the box than this, so that no triangle is cut by one.
constexpr int32_t kGridMargin = 8;

// `sites` are relative to the mesh's center. Errors: BadInput where a site is not finite, or so far away that the mesh would
// be left with too few grid steps.
// `crowded`: sites that are yet to be placed will lie closely somewhere, so that bins are made finer.
engine::Result<EventGrid> makeEventGrid(const Mesh& mesh, std::span<const Double3> sites, uint32_t site_count,
                                        bool crowded = false);

// Of objects that break together: the whole of every grid, with bins for the most sites that any of them has.
constexpr float kTileScale = 0x1p23f; // grid steps in half a grid's edge
EventGrid gridOfTiles(uint32_t tiles, uint32_t most_sites);

// Of the mesh's vertices, from its center.
double farthestCoordinate(const Mesh& mesh);

Int3 snapToGrid(const EventGrid& grid, const Double3& position);
Double3 fromGrid(const EventGrid& grid, const Int3& position);
inline Int4 withLast(const Int3& p, int32_t last) { return {p[0], p[1], p[2], last}; }

} // namespace brittle
