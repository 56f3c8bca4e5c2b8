# What tests, the bench and `brittle accuracy` measure by, in double precision; built without the rest of the tests.
set(measures clipped_cells contract convex geometry rigid_motion)
list(TRANSFORM measures PREPEND ${CMAKE_CURRENT_LIST_DIR}/reference/ OUTPUT_VARIABLE measure_sources)
list(TRANSFORM measure_sources APPEND .cpp)
add_library(brittle_measures STATIC ${CMAKE_CURRENT_LIST_DIR}/support/body_overlaps.cpp ${measure_sources})
target_link_libraries(brittle_measures PUBLIC brittle_module)
