# The bench of `brittle bench`. Voro++ and Bullet are part of it where Debian's voro++-dev and libbullet-dev are installed. CGAL
# (libcgal-dev) is a program of its own, brittle_peer_cgal, outside the default build: it takes longer to compile than all the
# rest.
find_path(VOROPP_HEADERS voro++.hh PATH_SUFFIXES voro++)
find_library(VOROPP_LIBRARY voro++)
find_path(BULLET_HEADERS btBulletDynamicsCommon.h PATH_SUFFIXES bullet)
find_library(BULLET_DYNAMICS BulletDynamics)
find_library(BULLET_COLLISION BulletCollision)
find_library(BULLET_MATH LinearMath)
find_path(CGAL_HEADERS CGAL/Surface_mesh.h)
find_library(GMP_LIBRARY gmp)
find_library(MPFR_LIBRARY mpfr)
set(bench_dir ${CMAKE_CURRENT_LIST_DIR})

add_library(brittle_bench_inputs STATIC ${bench_dir}/inputs.cpp ${bench_dir}/peer_voropp.cpp)
target_link_libraries(brittle_bench_inputs PUBLIC brittle_options)
if(VOROPP_HEADERS AND VOROPP_LIBRARY)
    target_compile_definitions(brittle_bench_inputs PRIVATE BRITTLE_PEER_VOROPP)
    target_include_directories(brittle_bench_inputs SYSTEM PRIVATE ${VOROPP_HEADERS})
    target_link_libraries(brittle_bench_inputs PRIVATE ${VOROPP_LIBRARY})
endif()

if(TARGET brittle_module)
    add_library(brittle_bench STATIC ${bench_dir}/bench.cpp ${bench_dir}/bench_breaking.cpp ${bench_dir}/bench_broad_phase.cpp ${bench_dir}/bench_caps.cpp
        ${bench_dir}/bench_cells.cpp ${bench_dir}/bench_colliders.cpp ${bench_dir}/bench_narrow_phase.cpp
        ${bench_dir}/bench_piles.cpp ${bench_dir}/bench_shatter.cpp ${bench_dir}/bench_startup.cpp
        ${bench_dir}/bench_variants.cpp ${bench_dir}/bullet_mover.cpp ${bench_dir}/bullet_shapes.cpp
        ${bench_dir}/our_side.cpp ${bench_dir}/peer_bullet.cpp ${bench_dir}/peer_cgal.cpp
        ${bench_dir}/phase_run.cpp)
    target_link_libraries(brittle_bench PUBLIC brittle_module PRIVATE brittle_bench_inputs brittle_device_check brittle_measures)
    if(BULLET_HEADERS AND BULLET_DYNAMICS AND BULLET_COLLISION AND BULLET_MATH)
        target_compile_definitions(brittle_bench PRIVATE BRITTLE_PEER_BULLET)
        target_include_directories(brittle_bench SYSTEM PRIVATE ${BULLET_HEADERS})
        target_link_libraries(brittle_bench PRIVATE ${BULLET_DYNAMICS} ${BULLET_COLLISION} ${BULLET_MATH})
    endif()
endif()
if(TARGET brittle)
    target_sources(brittle PRIVATE ${bench_dir}/bench_command.cpp ${bench_dir}/dynamics_report.cpp)
    target_link_libraries(brittle PRIVATE brittle_bench)
endif()

if(CGAL_HEADERS AND GMP_LIBRARY AND MPFR_LIBRARY AND VOROPP_HEADERS AND VOROPP_LIBRARY)
    add_executable(brittle_peer_cgal EXCLUDE_FROM_ALL ${bench_dir}/peer_cgal_main.cpp)
    target_include_directories(brittle_peer_cgal SYSTEM PRIVATE ${CGAL_HEADERS})
    target_link_libraries(brittle_peer_cgal PRIVATE brittle_bench_inputs ${MPFR_LIBRARY} ${GMP_LIBRARY})
    target_compile_options(brittle_peer_cgal PRIVATE -frounding-math)
endif()
