# Modules that the tests load: one that is sound, linked as well, and files that are wrong in one way each.
include(${PROJECT_SOURCE_DIR}/engine/engine_module.cmake)
set(loaded_dir ${CMAKE_CURRENT_LIST_DIR})
engine_module(tick_module SOURCES ${loaded_dir}/tick_module.cpp TABLE ${loaded_dir}/kernels.cmake ACCESSOR tickKernels)

set(loaded_modules tick_module_file)
foreach(fault name interface build create kernels frame)
    string(TOUPPER BAD_${fault} define)
    add_library(bad_${fault} MODULE ${loaded_dir}/bad_module.cpp)
    target_link_libraries(bad_${fault} PRIVATE engine)
    target_compile_definitions(bad_${fault} PRIVATE ${define})
    set_target_properties(bad_${fault} PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/modules)
    list(APPEND loaded_modules bad_${fault})
endforeach()
