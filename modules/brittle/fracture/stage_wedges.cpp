// Wedges of solid at edges where a surface touches itself: which sides of triangles bound the same one.
#include "modules/brittle/fracture/event.h"
#include "modules/brittle/fracture/firsts.h"

namespace brittle {

void recordWedges(const Event& e) {
    const auto& b = e.b;
    Recorder& r = e.record;
    const Length sides = Length::counted(COUNT_MESH_CORNERS);
    r.commands().beginLabel("pair_wedges");
    recordFirsts(r, "weld_corners", COUNT_MESH_VERTICES, b.grid_vertices,
                 {b.place_table, b.place_slots, b.first_vertices, b.place_flags});
    r.run("name_sides", Length::counted(COUNT_MESH_TRIANGLES), engine::NoPush{},
          {r.counts(), b.mesh_triangles, b.first_vertices, b.named_sides});
    recordFirsts(r, "weld_sides", COUNT_MESH_CORNERS, b.named_sides,
                 {b.place_table, b.place_slots, b.first_sides, b.place_flags});
    r.clear({b.side_heads});
    r.run("link_sides", sides, engine::NoPush{},
          {r.counts(), b.named_sides, b.first_sides, b.side_heads, b.side_links, b.wedges});
    r.run("pair_wedges", sides, engine::NoPush{},
          {r.counts(), b.grid_vertices, b.mesh_triangles, b.named_sides, b.first_sides, b.first_vertices, b.side_heads,
           b.side_links, b.open_wedges, b.wedges});
    r.commands().endLabel();
}

} // namespace brittle
