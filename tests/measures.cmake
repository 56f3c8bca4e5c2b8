# What tests and the bench both measure worlds by, in double precision; built without the rest of the tests.
add_library(brittle_measures STATIC ${CMAKE_CURRENT_LIST_DIR}/support/body_overlaps.cpp
    ${CMAKE_CURRENT_LIST_DIR}/reference/convex.cpp ${CMAKE_CURRENT_LIST_DIR}/reference/geometry.cpp)
target_link_libraries(brittle_measures PUBLIC brittle_module)
