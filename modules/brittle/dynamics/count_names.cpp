#include "modules/brittle/dynamics/count_names.h"

#include "shaders-spirv/shared/fracture.h"
#include "shaders-spirv/shared/solver.h"

#include <algorithm>
#include <iterator>
#include <span>

namespace brittle {
namespace {

struct CountName {
    uint32_t count;
    const char* name;
};

constexpr CountName kStep[] = {{COUNT_BOXES, "boxes"},
                               {COUNT_BOX_PAIRS, "pairs"},
                               {COUNT_TREE_BOXES, "boxes of the tree"},
                               {COUNT_TREE_PAIRS, "pairs of the tree"},
                               {COUNT_LONG_LISTS, "long lists"},
                               {COUNT_RADIX, "digits"},
                               {COUNT_CONTACTS, "contacts"},
                               {COUNT_FRESH_PAIRS, "fresh pairs"},
                               {COUNT_BY_COLOR, "once, where contacts go by color"},
                               {COUNT_BODIES, "bodies"},
                               {COUNT_ONCE, "once, unless all sleep"},
                               {COUNT_AWAKE, "bodies awake"},
                               {COUNT_SWIFT, "contacts, where a body is fast"},
                               {COUNT_SOLVED_APART, "islands, and all else"},
                               {COUNT_UNFINISHED, "islands, where one needs more dispatches"},
                               {COUNT_STRUCK, "pairs, where a contact breaks something"},
                               {COUNT_TURNING, "blows of bodies that turn"}};

constexpr CountName kFracture[] = {{COUNT_SITES, "sites"},
                                   {COUNT_NEIGHBORS, "neighbors of cells"},
                                   {COUNT_CORNERS, "corners of cells"},
                                   {COUNT_VORONOI_VERTICES, "Voronoi vertices"},
                                   {COUNT_VORONOI_EDGES, "Voronoi edges"},
                                   {COUNT_MIXED_EDGES, "edges that are cut"},
                                   {COUNT_CROSSINGS, "crossings"},
                                   {COUNT_MIXED_TRIANGLES, "triangles that are cut"},
                                   {COUNT_PAIRS, "triangles and cells"},
                                   {COUNT_ROUND, "triangles and cells of a round"},
                                   {COUNT_POLYGONS, "polygons"},
                                   {COUNT_SIDES, "sides of polygons"},
                                   {COUNT_TRIPLES, "triple points"},
                                   {COUNT_FAN_TRIANGLES, "triangles of fans"},
                                   {COUNT_POINTS, "points"},
                                   {COUNT_INTERVALS, "intervals"},
                                   {COUNT_SEGMENTS, "segments"},
                                   {COUNT_FACES, "cut faces"},
                                   {COUNT_CAP_TRIANGLES, "triangles of caps"},
                                   {COUNT_NODES, "corners of large faces"},
                                   {COUNT_COMPONENTS, "components"},
                                   {COUNT_TRIANGLES, "triangles"},
                                   {COUNT_FRAGMENTS, "fragments"},
                                   {COUNT_VALID, "triangles that are left"},
                                   {COUNT_EXACT_SMALL, "cells for the exact kernel"},
                                   {COUNT_EXACT_MEDIUM, "larger cells for the exact kernel"},
                                   {COUNT_EXACT_LARGE, "largest cells for the exact kernel"},
                                   {COUNT_HUGE_FACES, "huge faces"},
                                   {COUNT_LARGE_FACES, "large faces"},
                                   {COUNT_RADIX, "digits"},
                                   {COUNT_EMITTED, "triangles of fragments"},
                                   {COUNT_DRAWS, "draws"},
                                   {COUNT_CAVITIES, "cavities"},
                                   {COUNT_SUSPECTS, "suspect caps"},
                                   {COUNT_SUSPECT_SIDES, "sides of suspect caps"},
                                   {COUNT_FILMS, "films"},
                                   {COUNT_PARTS, "parts"},
                                   {COUNT_AGAIN, "triangles, where films were merged"},
                                   {COUNT_SORT, "triangles to sort"},
                                   {COUNT_WIDE_FACES, "wide faces"},
                                   {COUNT_ISLAND_PAIRS, "pairs of islands"},
                                   {COUNT_PARTINGS, "partings"},
                                   {COUNT_COLLIDERS, "hulls"},
                                   {COUNT_COLLIDER_FACES, "faces of hulls"},
                                   {COUNT_COLLIDER_VERTICES, "vertices of hulls"},
                                   {COUNT_COLLIDER_CORNERS, "corners of hulls"},
                                   {COUNT_BREAKING, "bodies that break"},
                                   {COUNT_SOUP_TRIANGLES, "triangles of what breaks"},
                                   {COUNT_SOUP_CORNERS, "corners of what breaks"},
                                   {COUNT_MESH_VERTICES, "vertices of meshes"},
                                   {COUNT_OWN_TRIANGLES, "outer triangles of meshes"},
                                   {COUNT_EARLIER_TRIANGLES, "triangles of earlier cuts"},
                                   {COUNT_MESH_TRIANGLES, "triangles of meshes"},
                                   {COUNT_MESH_CORNERS, "corners of meshes"},
                                   {COUNT_MESH_EDGES, "edges of meshes"},
                                   {COUNT_ASKED_SITES, "sites asked for"},
                                   {COUNT_BINS, "bins"},
                                   {COUNT_EVENT, "once, where something breaks"},
                                   {COUNT_CLEARING, "groups that clear, where something breaks"},
                                   {COUNT_VAST_FACES, "vast faces"},
                                   {COUNT_VAST_SIDES, "sides of vast faces"},
                                   {COUNT_VAST_HALVES, "half-edges of vast faces"},
                                   {COUNT_VAST_SPANS, "heights of vast faces"}};
static_assert(std::size(kFracture) == COUNT_TOTAL);

std::string nameIn(std::span<const CountName> names, uint64_t count) {
    const auto found = std::ranges::find(names, count, &CountName::count);
    return found == names.end() ? "count " + std::to_string(count) : found->name;
}

} // namespace

std::string nameOfCount(uint64_t count) {
    if (count >= COUNT_FIRST_COLOR && count < COUNT_FIRST_COLOR + WIDE_COLORS)
        return "contacts of color " + std::to_string(count - COUNT_FIRST_COLOR);
    return nameIn(kStep, count);
}

std::string nameOfFractureCount(uint64_t count) { return nameIn(kFracture, count); }

} // namespace brittle
