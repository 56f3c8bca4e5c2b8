# What tests, the bench, `brittle accuracy` and `brittle hard` measure by, in double precision, and the hard cases themselves; built
# without the rest of the tests.
set(measures
    hard/compared_scenes hard/hard_case hard/hard_fractures hard/hard_meshes hard/hard_scenes hard/hard_sites hard/hard_worlds hard/moving_scenes
    hard/long_motions hard/refusing_scenes hard/resting_scenes
    reference/big_int reference/boxes reference/clipped_cells reference/contract reference/convex reference/geometry
    reference/predicates reference/rigid_motion reference/rigid_stack reference/soft_contact reference/voronoi
    support/body_overlaps support/fragment_file support/inset_hull support/measured_scene support/mover support/scaled_mover support/scaled_scene
    support/stacked_boxes support/world_mover)
list(TRANSFORM measures PREPEND ${CMAKE_CURRENT_LIST_DIR}/ OUTPUT_VARIABLE measure_sources)
list(TRANSFORM measure_sources APPEND .cpp)
add_library(brittle_measures STATIC ${measure_sources})
target_link_libraries(brittle_measures PUBLIC brittle_module)
