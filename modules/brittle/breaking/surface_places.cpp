#include "modules/brittle/breaking/surface_places.h"

#include <algorithm>
#include <map>

namespace brittle {
namespace {

// First triangle, and how many. Bodies of one shape that only are drawn share theirs.
using Surfaces = std::map<uint32_t, uint32_t>;

Surfaces surfacesOf(const WorldContents& contents) {
    Surfaces surfaces;
    const auto add = [&](const gpu::uvec4& surface) {
        if (const uint32_t corners = surface.y + surface.z; corners > 0) surfaces[surface.x / 3] = corners / 3;
    };
    for (const gpu::BreakableBody& body : contents.breakable)
        if (body.surface.w != NO_INDEX) add(body.surface);
    for (const gpu::BodyLook& look : contents.looks)
        add(look.surface);
    return surfaces;
}

uint32_t partFor(const Surfaces& surfaces, uint32_t wanted) {
    uint32_t largest = 0;
    for (const auto& [first, triangles] : surfaces)
        largest = std::max(largest, triangles);
    const uint32_t part = std::max(wanted, largest + 1);
    return (part + kPartsMultiple - 1) / kPartsMultiple * kPartsMultiple;
}

// The unused triangle at the end of the part that `at` lies in.
uint32_t endOfPart(uint32_t at, uint32_t part) { return (at / part + 1) * part - 1; }

void addFree(SurfacePlaces& places, uint32_t begin, uint32_t end) {
    if (begin < end) places.free.push_back({begin, end - begin});
}

// Returns where the last one ends.
uint32_t place(const Surfaces& surfaces, SurfacePlaces& places) {
    uint32_t at = 0;
    for (const auto& [first, triangles] : surfaces) {
        if (const uint32_t end = endOfPart(at, places.part_triangles); at + triangles > end) {
            addFree(places, at, end);
            at = end + 1;
        }
        places.moved[first] = at;
        at += triangles;
    }
    return at;
}

} // namespace

SurfacePlaces placeSurfaces(const WorldContents& contents, uint32_t room, uint32_t part_triangles) {
    const Surfaces surfaces = surfacesOf(contents);
    SurfacePlaces places;
    places.part_triangles = partFor(surfaces, part_triangles);
    uint32_t at = place(surfaces, places);
    for (uint32_t left = std::min<uint32_t>(room, INT32_MAX); left > 0;) {
        const uint32_t end = endOfPart(at, places.part_triangles), taken = std::min(left, end - at);
        addFree(places, at, at + taken);
        left -= taken;
        at += taken + (left > 0 ? 1 : 0);
    }
    places.capacity = at;
    return places;
}

void moveSurfaces(WorldContents& contents, const SurfacePlaces& places) {
    std::vector<FragmentVertex> list(3 * size_t{places.capacity});
    for (const auto& [first, triangles] : surfacesOf(contents))
        std::copy_n(contents.surface_vertices.begin() + 3 * ptrdiff_t{first}, 3 * size_t{triangles},
                    list.begin() + 3 * ptrdiff_t{places.moved.at(first)});
    contents.surface_vertices = std::move(list);
    for (gpu::BreakableBody& body : contents.breakable)
        if (body.surface.w != NO_INDEX) body.surface.x = 3 * places.moved.at(body.surface.x / 3);
    for (gpu::BodyLook& look : contents.looks)
        if (look.surface.y + look.surface.z > 0) look.surface.x = 3 * places.moved.at(look.surface.x / 3);
}

} // namespace brittle
