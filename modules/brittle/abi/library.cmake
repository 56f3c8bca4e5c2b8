# libbrittle.so, which exports the C ABI and nothing else, and how it is installed: library, header, a package for CMake's
# find_package(brittle) with the target brittle::brittle, and one for pkg-config.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

file(GLOB abi_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/modules/brittle/abi/*.cpp)
set(exports ${PROJECT_SOURCE_DIR}/modules/brittle/abi/exports.map)
add_library(brittle_abi OBJECT ${abi_sources}) # of this library, and of plugins that have all of Brittle in them
target_link_libraries(brittle_abi PUBLIC brittle_module Eigen3::Eigen)
add_library(brittle_library SHARED)
target_link_libraries(brittle_library PRIVATE brittle_abi)
target_include_directories(brittle_library INTERFACE
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/modules/brittle> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
# Of what the module links for its programs, the library keeps what it uses.
target_link_options(brittle_library PRIVATE -Wl,--as-needed -Wl,--exclude-libs,ALL -Wl,--version-script=${exports})
set_target_properties(brittle_library PROPERTIES OUTPUT_NAME brittle EXPORT_NAME brittle VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} LINK_DEPENDS ${exports}
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
add_library(brittle::brittle ALIAS brittle_library)

install(TARGETS brittle_library EXPORT brittle LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library)
install(FILES ${PROJECT_SOURCE_DIR}/modules/brittle/brittle.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT library)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/brittle)
install(EXPORT brittle NAMESPACE brittle:: DESTINATION ${package} FILE brittle-config.cmake COMPONENT library)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/brittle-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/brittle-config-version.cmake DESTINATION ${package} COMPONENT library)

# The prefix is found from where the file lies, so that an installed tree may be moved.
file(RELATIVE_PATH to_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
file(CONFIGURE OUTPUT brittle.pc @ONLY CONTENT "prefix=\${pcfiledir}/${to_prefix}
libdir=\${prefix}/${CMAKE_INSTALL_LIBDIR}
includedir=\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}

Name: brittle
Description: real-time fracture for engines, on Vulkan compute
Version: ${PROJECT_VERSION}
Libs: -L\${libdir} -lbrittle
Cflags: -I\${includedir}
")
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/brittle.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT library)
