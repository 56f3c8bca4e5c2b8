# engine_module(NAME SOURCES file... [TABLE kernels.cmake ACCESSOR name] [LIBRARIES target...]): a module from the same sources in both of
# its forms: NAME, a static library to be linked, and NAME_file, NAME.so to be loaded (engine/module_entry.h). The table of kernels is
# that of shader_library(), shaders::ACCESSOR().
include(${CMAKE_CURRENT_LIST_DIR}/../shaders-spirv/shader_library.cmake)

function(engine_module name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "TABLE;ACCESSOR" "SOURCES;LIBRARIES")
    if(arg_TABLE)
        shader_library(${name}_shaders TABLE ${arg_TABLE} ACCESSOR ${arg_ACCESSOR})
        list(APPEND arg_LIBRARIES ${name}_shaders)
    endif()
    add_library(${name} STATIC ${arg_SOURCES})
    target_link_libraries(${name} PUBLIC engine ${arg_LIBRARIES})
    add_library(${name}_file MODULE ${arg_SOURCES})
    target_link_libraries(${name}_file PRIVATE engine ${arg_LIBRARIES})
    target_compile_definitions(${name}_file PRIVATE ENGINE_MODULE_SHARED)
    # What it has of the engine is its own: nothing of it meets the program's.
    target_link_options(${name}_file PRIVATE -Wl,--exclude-libs,ALL)
    set_target_properties(${name}_file PROPERTIES PREFIX "" OUTPUT_NAME ${name}
        LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/modules)
endfunction()
