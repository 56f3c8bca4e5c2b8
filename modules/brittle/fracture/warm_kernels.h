// Kernels to get ready while the first event is being recorded and begins to run.
#pragma once

#include <string_view>
#include <vector>

namespace brittle {

// The rarer ones of large cells and faces are left out: they are made where an event meets such a case.
inline std::vector<std::string_view> kernelsToWarm() {
    return {// long to compile, met late
            "clip_triangles", "place_triples", "cap_faces_large", "cap_faces", "cap_fans",
            // the end of the event, backwards from where the event itself will not have come yet
            "mass_properties", "decide_fates", "emit", "emit_objects", "allocate", "unite_triangles", "flag_components",
            "key_triangles", "publish_tiles", "radix_count", "radix_scatter", "bound_components", "classify_pieces",
            "list_caps", "list_fans", "list_whole", "order_triples", "cap_intervals", "start_depth", "jump_depth",
            "group_triples", "assign_triples", "place_voronoi", "weld_points", "weld_positions", "cap_cuts", "flag_faces"};
}

} // namespace brittle
