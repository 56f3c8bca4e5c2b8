# The plugin for Godot 4: one shared library, with Brittle in it and nothing exported but the function that the engine calls, so it
# meets no other libbrittle of the process, and an addon is a folder to be copied. What Brittle needs that is not on every machine,
# Qhull, is installed beside it.
file(GLOB_RECURSE godot_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/modules/brittle/godot/*.cpp)
set(godot_exports ${PROJECT_SOURCE_DIR}/modules/brittle/godot/exports.map)
add_library(brittle_godot MODULE ${godot_sources})
target_link_libraries(brittle_godot PRIVATE brittle_abi)
target_link_options(brittle_godot PRIVATE -Wl,--as-needed -Wl,--exclude-libs,ALL -Wl,--version-script=${godot_exports})

# An addon as projects have it, in the build folder and where it is installed; the demo beside it has it as its own.
set(godot_addon ${CMAKE_BINARY_DIR}/godot/addons/brittle)
set_target_properties(brittle_godot PROPERTIES INSTALL_RPATH "$ORIGIN" LINK_DEPENDS ${godot_exports} LIBRARY_OUTPUT_DIRECTORY ${godot_addon})
configure_file(${PROJECT_SOURCE_DIR}/modules/brittle/godot/addon/brittle.gdextension ${godot_addon}/brittle.gdextension COPYONLY)

set(godot_installed ${CMAKE_INSTALL_DATADIR}/brittle/godot)
install(TARGETS brittle_godot RUNTIME_DEPENDENCY_SET godot_needs LIBRARY DESTINATION ${godot_installed}/demo/addons/brittle
    COMPONENT godot)
install(RUNTIME_DEPENDENCY_SET godot_needs PRE_EXCLUDE_REGEXES ".*" PRE_INCLUDE_REGEXES qhull
    LIBRARY DESTINATION ${godot_installed}/demo/addons/brittle COMPONENT godot)
install(FILES ${godot_addon}/brittle.gdextension ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${godot_installed}/demo/addons/brittle
    COMPONENT godot)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/modules/brittle/godot/demo DESTINATION ${godot_installed} COMPONENT godot)
# The engine has to know of an extension before it looks at a project for the first time, or it ends there.
install(FILES ${PROJECT_SOURCE_DIR}/modules/brittle/godot/addon/extension_list.cfg DESTINATION ${godot_installed}/demo/.godot COMPONENT godot)
