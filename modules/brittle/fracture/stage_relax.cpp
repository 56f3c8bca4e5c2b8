// Lloyd's relaxation: cells are cut, sites go to their centroids, and all of it again.
#include "modules/brittle/fracture/event.h"

namespace brittle {
namespace {

struct RelaxPush {
    Int4 low, high, box_low, box_high;
    uint32_t slots;
};

} // namespace

void recordRelaxation(const Event& e) {
    const auto& b = e.b;
    const EventGrid& g = e.grid;
    const TriangleColumns& columns = e.placement->columns;
    const RelaxPush push = {withLast(g.mesh_low, columns.edge), withLast(g.mesh_high, columns.per_row), withLast(g.box_low, 0),
                            withLast(g.box_high, 0), e.capacity.sites};
    if (e.search == Search::SphereTree) recordSphereTree(e);
    e.record.commands().beginLabel("relax_sites");
    recordCutting(e);
    e.record.run("relax_sites", Length::of(e.capacity.sites), push,
                 {e.record.counts(), b.sites, b.cell_raw, b.raw, b.grid_vertices, b.mesh_triangles, b.column_start,
                  b.column_triangles, b.raw_sites});
    e.record.clear({e.record.counts().sub(4 * COUNT_EXACT_SMALL, 12), e.record.groupsOf(COUNT_EXACT_SMALL)});
    recordKeptSites(e);
    e.record.commands().endLabel();
}

} // namespace brittle
