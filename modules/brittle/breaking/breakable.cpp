#include "modules/brittle/breaking/breakable.h"

#include "modules/brittle/effects/blow.h"
#include "modules/brittle/fracture/wedges.h"
#include "modules/brittle/mesh/vector_math.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace brittle {
namespace {

using engine::Error;
using engine::ErrorCode;
using engine::Result;

// Of equal cards there is one.
uint32_t cardIndex(WorldContents& contents, const Material& material) {
    const gpu::MaterialCard card = cardOf(material);
    const auto same = [&](const gpu::MaterialCard& other) { return std::memcmp(&card, &other, sizeof card) == 0; };
    const auto found = std::ranges::find_if(contents.cards, same);
    const auto index = static_cast<uint32_t>(found - contents.cards.begin());
    if (found == contents.cards.end()) contents.cards.push_back(card);
    return index;
}

struct Extent {
    double area = 0;
    Float3 low = {1e30f, 1e30f, 1e30f}, high = {-1e30f, -1e30f, -1e30f};
};

// Three vertices a triangle, as the device has them.
Extent addTriangles(std::vector<FragmentVertex>& pool, const SurfaceMesh& surface) {
    Extent extent;
    for (size_t t = 0; t + 2 < surface.indices.size(); t += 3) {
        Double3 p[3];
        for (size_t k = 0; k < 3; ++k) {
            const FragmentVertex& v = surface.vertices[surface.indices[t + k]];
            pool.push_back(v);
            p[k] = positionOf(v);
            for (size_t axis = 0; axis < 3; ++axis) {
                extent.low[axis] = std::min(extent.low[axis], v.position[axis]);
                extent.high[axis] = std::max(extent.high[axis], v.position[axis]);
            }
        }
        extent.area += 0.5 * length(cross(p[1] - p[0], p[2] - p[0]));
    }
    return extent;
}

// On the grid that breaking/admit_breaking.comp chooses.
bool mayTouchItself(const SurfaceMesh& surface, const Extent& extent) {
    float half_size = 0;
    for (size_t k = 0; k < 3; ++k)
        half_size = std::max(half_size, 0.5f * (extent.high[k] - extent.low[k]));
    EventGrid grid;
    grid.scale = std::ldexp(kTileScale, -std::ilogb(half_size) - 1);
    SnappedMesh snapped(surface.indices.size());
    for (const uint32_t index : surface.indices) {
        const float* p = surface.vertices[index].position;
        Double3 way;
        for (size_t k = 0; k < 3; ++k)
            way[k] = p[k] - 0.5f * (extent.low[k] + extent.high[k]); // rounded to a float, as on the device
        snapped.addVertex(snapToGrid(grid, way));
    }
    for (uint32_t k = 0; k + 2 < surface.indices.size(); k += 3)
        snapped.addTriangle({k, k + 1, k + 2});
    return snapped.mayTouchItself();
}

} // namespace

gpu::BreakableBody unbreakable() {
    gpu::BreakableBody body{};
    body.surface = {0, 0, 0, NO_INDEX};
    body.turn = {0, 0, 0, 1};
    return body;
}

Result<void> makeBreakable(WorldContents& contents, const BreakableDefinition& d) {
    if (d.surface.indices.empty() || !(d.volume > 0))
        return Error{ErrorCode::BadInput, "body \"" + d.definition.name + "\" has no closed surface that could break"};
    contents.breakable.resize(contents.bodies.size(), unbreakable());
    gpu::BreakableBody& body = contents.breakable[d.body];
    const auto first = static_cast<uint32_t>(contents.surface_vertices.size());
    const Extent extent = addTriangles(contents.surface_vertices, d.surface);
    contents.some_surface_may_touch_itself = contents.some_surface_may_touch_itself || mayTouchItself(d.surface, extent);
    const uint32_t own = d.surface.outer_index_count, other = static_cast<uint32_t>(d.surface.indices.size()) - own;
    const Turn axes = axesOf(d.definition);
    body.surface = {first, own, other, cardIndex(contents, d.material)};
    const double strength = strengthOf(d.material, d.volume, chanceOf(d.seed, d.body));
    body.form = {static_cast<float>(d.volume), static_cast<float>(extent.area), static_cast<float>(strength), 0};
    body.low = {extent.low[0], extent.low[1], extent.low[2], 0};
    body.high = {extent.high[0], extent.high[1], extent.high[2], static_cast<float>(d.pattern)};
    body.balance = {0, 0, 0, 0};
    body.turn = {static_cast<float>(-axes[0]), static_cast<float>(-axes[1]), static_cast<float>(-axes[2]),
                 static_cast<float>(axes[3])};
    return {};
}

} // namespace brittle
