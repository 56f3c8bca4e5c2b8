# `brittle accuracy`, what accuracy costs in time, and `brittle hard`, which shows its cases on the same page. The page and one
# example scene lie in the program.
set(accuracy_dir ${CMAKE_CURRENT_LIST_DIR})
# What measurements are held against, and what they say: apart from the program, for tests.
set(accuracy_judgment fracture_truth judge price_list results results_check results_json scene_truth)
list(TRANSFORM accuracy_judgment PREPEND ${accuracy_dir}/)
list(TRANSFORM accuracy_judgment APPEND .cpp)
if(TARGET brittle_module)
    add_library(brittle_accuracy STATIC ${accuracy_judgment})
    set_source_files_properties(${accuracy_dir}/results_json.cpp PROPERTIES COMPILE_OPTIONS $<$<CONFIG:RelWithDebInfo>:-O1>)
    target_link_libraries(brittle_accuracy PUBLIC brittle_measures PRIVATE nlohmann_json::nlohmann_json)
endif()
if(TARGET brittle)
    set(page_dir ${accuracy_dir}/page)
    set(window_scene ${PROJECT_SOURCE_DIR}/modules/brittle/scene/examples/window_pane.toml)
    set(embedded ${CMAKE_CURRENT_BINARY_DIR}/accuracy_files.S)
    configure_file(${accuracy_dir}/embedded_files.S.in ${embedded} @ONLY)
    file(GLOB page_files CONFIGURE_DEPENDS ${page_dir}/*)
    set_source_files_properties(${embedded} PROPERTIES OBJECT_DEPENDS "${page_files};${window_scene}")

    set(generated ${CMAKE_CURRENT_BINARY_DIR}/generated)
    set(version_header ${generated}/tools/accuracy/version.h)
    add_custom_target(brittle_version BYPRODUCTS ${version_header} COMMENT "version of brittle" COMMAND ${CMAKE_COMMAND}
        -DSOURCE_DIR=${PROJECT_SOURCE_DIR} -DVERSION=${PROJECT_VERSION}
        "-DCOMPILER=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}, ${CMAKE_BUILD_TYPE}" -DOUTPUT=${version_header}
        -P ${accuracy_dir}/version.cmake)

    file(GLOB accuracy_sources CONFIGURE_DEPENDS ${accuracy_dir}/*.cpp ${accuracy_dir}/../hard/*.cpp)
    list(REMOVE_ITEM accuracy_sources ${accuracy_judgment})
    target_sources(brittle PRIVATE ${accuracy_sources} ${embedded})
    target_include_directories(brittle PRIVATE ${generated})
    target_link_libraries(brittle PRIVATE brittle_accuracy brittle_bench_inputs)
    add_dependencies(brittle brittle_version)
endif()
