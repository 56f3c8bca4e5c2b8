#include "modules/brittle/breaking/room_to_break.h"

#include "modules/brittle/breaking/break.h"
#include "modules/brittle/breaking/breakable.h"
#include "shaders-spirv/shared/debris.h"
#include "shaders-spirv/shared/pool.h"

#include <algorithm>
#include <functional>
#include <string>

namespace brittle {
namespace {

using engine::Error, engine::ErrorCode;

constexpr uint32_t kFragments = 1024, kMostUsualFragments = 8192, kFacesOfOne = 24, kTrianglesOfOne = 96;
constexpr uint32_t kUsualForEach = 4, kMostKeptForEach = 32; // fragments
constexpr uint32_t kStepBodies = 16, kStepTriangles = 8192, kStepSites = 512, kFragmentsOfOne = 256, kParticles = 16384;
constexpr uint64_t kMostUsualTriangles = 4ull * (kUsualPart - 1); // 96 bytes each: half a gigabyte

uint32_t timesRounded(uint32_t count, uint32_t each) { return (count + each - 1) / each; }

// How many faces' worth of room a hull takes.
uint32_t faceRoom(const gpu::HullRecord& hull) {
    return std::max({hull.count.y, timesRounded(hull.count.x, VERTICES_A_FACE), timesRounded(hull.count.w, EDGES_A_FACE),
                     timesRounded(hull.count.z, CORNERS_A_FACE)});
}

uint32_t faceRoom(const WorldContents& contents) {
    uint32_t faces = 0;
    for (const gpu::PieceRecord& piece : contents.pieces)
        faces += faceRoom(contents.hulls.records[piece.ids.x]);
    return faces;
}

uint32_t trianglesOf(const gpu::BreakableBody& body) { return (body.surface.y + body.surface.z) / 3; }

// Two large bodies that break in one step are rare: the other waits.
uint32_t usualStepTriangles(uint32_t largest) { return std::max(kStepTriangles, largest + std::min(largest, 65'536u)); }

// Room for the fragments of as many of the largest bodies as there is room for, if each breaks into the most.
uint32_t usualTriangles(const WorldContents& contents, uint32_t fragments, uint32_t most_fragments) {
    std::vector<uint32_t> surfaces;
    for (const gpu::BreakableBody& body : contents.breakable)
        surfaces.push_back(trianglesOf(body));
    std::ranges::sort(surfaces, std::greater());
    surfaces.resize(std::min<size_t>(surfaces.size(), std::max(fragments / most_fragments, 1u)));
    uint64_t triangles = 0;
    for (const uint32_t surface : surfaces)
        triangles += usualFragmentTriangles(surface, std::min(most_fragments, fragments));
    triangles = std::max(triangles, kTrianglesOfOne * uint64_t{fragments});
    const uint64_t left = kMostUsualTriangles - std::min<uint64_t>(kMostUsualTriangles, contents.surface_vertices.size() / 3);
    return static_cast<uint32_t>(std::min(triangles, std::max<uint64_t>(left, 1)));
}

bool breaksInRays(const gpu::BreakableBody& body) {
    return body.surface.w != NO_INDEX && static_cast<uint32_t>(body.high.w) == PATTERN_RADIAL;
}

uint32_t chosen(uint32_t given, uint32_t usual) { return given != 0 ? given : usual; }

template <class T>
void copyRange(const std::vector<T>& from, size_t first, size_t count, std::vector<T>& to, size_t at) {
    std::copy_n(from.begin() + static_cast<ptrdiff_t>(first), count, to.begin() + static_cast<ptrdiff_t>(at));
}

void copyHull(const HullSet& from, gpu::HullRecord record, uint32_t first_face, HullSet& to, uint32_t slot) {
    copyRange(from.vertices, record.first.x, record.count.x, to.vertices, VERTICES_A_FACE * first_face);
    copyRange(from.faces, record.first.y, record.count.y, to.faces, first_face);
    copyRange(from.corners, record.first.z, record.count.z, to.corners, CORNERS_A_FACE * first_face);
    copyRange(from.edges, record.first.w, record.count.w, to.edges, EDGES_A_FACE * first_face);
    for (uint32_t f = 0; f < record.count.y; ++f)
        to.faces[first_face + f].loop.x += CORNERS_A_FACE * first_face - record.first.z;
    record.first = {VERTICES_A_FACE * first_face, first_face, CORNERS_A_FACE * first_face, EDGES_A_FACE * first_face};
    to.records[slot] = record;
}

HullSet spreadHulls(const WorldContents& contents, const RoomToBreak& room) {
    const uint32_t faces = room.pools.capacity[POOL_FACES];
    HullSet spread;
    spread.records.resize(room.pools.capacity[POOL_PIECES]);
    spread.vertices.resize(size_t{VERTICES_A_FACE} * faces);
    spread.faces.resize(faces);
    spread.corners.resize(size_t{CORNERS_A_FACE} * faces);
    spread.edges.resize(size_t{EDGES_A_FACE} * faces);
    uint32_t first = 0;
    for (uint32_t slot = 0; slot < contents.pieces.size(); ++slot) {
        const gpu::HullRecord& record = contents.hulls.records[contents.pieces[slot].ids.x];
        copyHull(contents.hulls, record, first, spread, slot);
        first += faceRoom(record);
    }
    return spread;
}

gpu::BodyState absentBody() {
    gpu::BodyState body{};
    body.sector.w = BODY_ABSENT;
    body.turn = {0, 0, 0, 1};
    return body;
}

} // namespace

uint32_t largestSurface(const WorldContents& contents) {
    uint32_t most = 0;
    for (const gpu::BreakableBody& body : contents.breakable)
        most = std::max(most, trianglesOf(body));
    return most;
}

RoomToBreak roomInAStep(uint32_t largest_surface, const BreakingBudget& budget) {
    RoomToBreak room;
    room.step_bodies = std::min<uint32_t>(chosen(budget.step_bodies, kStepBodies), MOST_BREAKING);
    room.step_triangles = chosen(budget.step_triangles, usualStepTriangles(largest_surface));
    room.step_sites = chosen(budget.step_sites, kStepSites);
    room.most_fragments = std::min(chosen(budget.most_fragments, kFragmentsOfOne), room.step_sites);
    return room;
}

engine::Result<RoomToBreak> roomToBreak(const WorldContents& contents, const BreakingBudget& budget) {
    RoomToBreak room = roomInAStep(largestSurface(contents), budget);
    // What cannot break needs no room.
    const auto breaks = [](const gpu::BreakableBody& body) { return body.surface.w != NO_INDEX; };
    const auto breakable = static_cast<uint32_t>(std::ranges::count_if(contents.breakable, breaks));
    const uint32_t fragments = chosen(budget.fragments, std::clamp(kUsualForEach * breakable, kFragments, kMostUsualFragments));
    room.whole = breakable;
    room.touching = contents.some_surface_may_touch_itself;
    room.radial = std::ranges::any_of(contents.breakable, breaksInRays);
    room.kept_for_each = std::min(kMostKeptForEach, fragments / (2 * std::max(breakable, 1u)));
    room.kept_for_whole = fragments / 2;
    if (room.most_fragments < 2)
        return Error{ErrorCode::BadInput,
                     std::string("a budget of one ") +
                         (room.step_sites < 2 ? "site for all that breaks in a step" : "fragment for a body") +
                         ": what breaks has two fragments at least; give 2 or more, or 0 for the default"};
    room.particles = chosen(budget.particles, kParticles);
    room.bodies = static_cast<uint32_t>(contents.bodies.size());
    room.pieces = static_cast<uint32_t>(contents.pieces.size());
    const uint32_t faces = faceRoom(contents);
    room.surfaces = placeSurfaces(contents, chosen(budget.triangles, usualTriangles(contents, fragments, room.most_fragments)),
                                  chosen(budget.part_triangles, kUsualPart));
    PoolRoom& pools = room.pools;
    pools.capacity = {room.bodies + fragments, room.pieces + fragments, faces + chosen(budget.faces, kFacesOfOne * fragments),
                      room.surfaces.capacity};
    pools.objects = fragments + breakable + room.surfaces.parts() - 1; // the triangle between two parts is taken, too
    pools.owners = room.step_bodies;
    pools.returned = std::max<uint32_t>(room.step_bodies, MOST_EXPIRING);
    if (const uint32_t beside = pools.ranges() - fragments; pools.ranges() > POOL_MOST_FREE)
        return Error{ErrorCode::Capacity, "a budget of " + std::to_string(fragments) +
                                              " fragments at a time: beside these bodies there is room for " +
                                              std::to_string(POOL_MOST_FREE - std::min<uint32_t>(beside, POOL_MOST_FREE)) +
                                              " at most; give a smaller budget of fragments"};
    const std::array<uint32_t, POOL_TRIANGLES> taken = {room.bodies, room.pieces, faces};
    for (size_t k = 0; k < taken.size(); ++k)
        room.free[k] = {{taken[k], pools.capacity[k] - taken[k]}};
    room.free[POOL_TRIANGLES] = room.surfaces.free;
    if (auto state = poolsWith(pools, room.free); !state) return state.error();
    return room;
}

WorldContents withRoom(const WorldContents& contents, const RoomToBreak& room) {
    WorldContents larger = contents;
    larger.hulls = spreadHulls(contents, room);
    for (uint32_t slot = 0; slot < larger.pieces.size(); ++slot)
        larger.pieces[slot].ids.x = slot;
    larger.pieces.resize(room.pools.capacity[POOL_PIECES], {{0, NO_INDEX, 0, 0}});
    larger.bodies.resize(room.pools.capacity[POOL_BODIES], absentBody());
    larger.shapes.resize(larger.bodies.size());
    larger.ids.resize(larger.bodies.size());
    larger.breakable.resize(larger.bodies.size(), unbreakable());
    moveSurfaces(larger, room.surfaces);
    return larger;
}

} // namespace brittle
