#include "tests/module/breaking_fragments.h"

#include "modules/brittle/fracture/event_grid.h"
#include "modules/brittle/fracture/refracture.h"
#include "modules/brittle/mesh/vector_math.h"
#include "tests/module/whole_fracture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace breaking_test {

using brittle::PreparedMesh;
using brittle::operator-;

namespace {

float hostScale(const PreparedMesh& object) {
    const auto grid = brittle::makeEventGrid(object.mesh, {}, 1);
    EXPECT_TRUE(grid);
    return grid->scale / brittle::kTileScale;
}

// Grid coordinates of an object's place.
gpu::ivec4 onGrid(const brittle::Float3& p, int32_t last) {
    const auto snap = [](float x) { return static_cast<int32_t>(std::nearbyint(double{x} * 0x1p23)) + (1 << 23); };
    return {snap(p[0]), snap(p[1]), snap(p[2]), last};
}

// Every fragment of the set.
Breaking breakingOf(brittle::FragmentSet set, float scale) {
    Breaking b;
    b.set = std::move(set);
    for (size_t f = 0; f < b.set.fragments.size(); ++f) {
        auto prepared = brittle::prepareFragment(b.set, f);
        EXPECT_TRUE(prepared) << prepared.error().message;
        const brittle::Fragment& fragment = b.set.fragments[f];
        const brittle::Double3 center = prepared->mesh.center - b.set.center;
        const uint32_t own = fragment.outer_index_count - fragment.earlier_index_count;
        const uint32_t other = fragment.earlier_index_count + fragment.inner_index_count;
        b.records.push_back({{static_cast<float>(center[0]), static_cast<float>(center[1]), static_cast<float>(center[2]),
                              scale > 0 ? scale : hostScale(*prepared)},
                             {fragment.first_vertex, own, other, b.corners}});
        b.corners += own + other;
        b.prepared.push_back(std::move(*prepared));
    }
    return b;
}

} // namespace

Breaking breakingFragments(const char* name, uint32_t sites, float scale) {
    const whole::Model model = whole::modelFrom(name);
    brittle::FractureOptions options;
    options.site_count = sites;
    auto broken = whole::fracture().shatter(model.prepared.mesh, model.prepared.topology, options);
    EXPECT_TRUE(broken) << broken.error().message;
    return breakingOf(std::move(broken->fragments), scale);
}

Breaking breakingSolid(const brittle::ImportedMesh& solid) {
    brittle::FragmentSet set;
    for (const brittle::Index3& corners : solid.triangles)
        for (const uint32_t corner : corners) {
            brittle::FragmentVertex v{};
            for (size_t k = 0; k < 3; ++k)
                v.position[k] = static_cast<float>(solid.positions[corner][k]);
            set.indices.push_back(static_cast<uint32_t>(set.vertices.size()));
            set.vertices.push_back(v);
        }
    brittle::Fragment fragment;
    fragment.vertex_count = fragment.outer_index_count = static_cast<uint32_t>(set.indices.size());
    set.fragments = {fragment};
    return breakingOf(std::move(set), 0);
}

brittle::Float3 scaledPlace(const PreparedMesh& object, uint32_t vertex, float scale) {
    brittle::Float3 p = object.mesh.positions[vertex];
    for (float& x : p)
        x *= scale;
    return p;
}

void hit(Breaking& breaking, uint32_t sites, int32_t contact_radius, int32_t seed) {
    for (size_t k = 0; k < breaking.records.size(); ++k) {
        const PreparedMesh& object = breaking.prepared[k];
        gpu::BreakingRecord& r = breaking.records[k];
        const auto place = [&](uint32_t v) { return scaledPlace(object, v, r.center.w); };
        brittle::Float3 low = place(0), high = low;
        for (uint32_t v = 0; v < object.mesh.positions.size(); ++v)
            for (size_t c = 0; c < 3; ++c) {
                low[c] = std::min(low[c], place(v)[c]);
                high[c] = std::max(high[c], place(v)[c]);
            }
        const double furthest =
            std::hypot(double{high[0]} - low[0], double{high[1]} - low[1], double{high[2]} - low[2]) * 0x1p23;
        r.impact = onGrid(place(0), contact_radius);
        r.low = onGrid(low, static_cast<int32_t>(furthest) + 1);
        r.high = onGrid(high, seed);
        r.sites = {static_cast<uint32_t>(k) * sites, sites, 0, 0};
    }
    breaking.sites = sites * static_cast<uint32_t>(breaking.records.size());
}

} // namespace breaking_test
