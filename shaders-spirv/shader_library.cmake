# shader_library(TARGET TABLE file ACCESSOR name): compiles every kernel(...) row of a table to SPIR-V and embeds the words
# in a static library, where shaders::name() lists them.
#
# A kernel runs through glslangValidator (with a depfile, so that a touched include rebuilds exactly its users), spirv-opt
# and spirv-val; the result stays in the build tree as spirv/NAME.spv. engine/reload/glsl_compiler.cpp does the same at run time.
find_program(GLSLANG glslangValidator REQUIRED)
find_program(SPIRV_OPT spirv-opt REQUIRED)
find_program(SPIRV_VAL spirv-val REQUIRED)
set(SHADER_INCLUDE_DIR ${CMAKE_CURRENT_LIST_DIR})

# kernel(FILE [NAME n] [DEFINES A=1 B=2]): FILE is relative to the table. The name of a compute kernel defaults to the
# file's stem, that of another stage to the file's whole name.
function(kernel file)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "NAME" "DEFINES")
    get_filename_component(extension ${file} LAST_EXT)
    get_filename_component(name ${file} NAME)
    if(extension STREQUAL ".comp")
        get_filename_component(name ${file} NAME_WE)
    endif()
    if(arg_NAME)
        set(name ${arg_NAME})
    endif()
    set(defines ${arg_DEFINES})
    list(TRANSFORM defines PREPEND -D)

    set(source ${shader_source_dir}/${file})
    set(raw ${CMAKE_BINARY_DIR}/spirv/raw/${name}.spv)
    set(module ${CMAKE_BINARY_DIR}/spirv/${name}.spv)
    add_custom_command(OUTPUT ${raw}
        COMMAND ${GLSLANG} --target-env vulkan1.1 -V --quiet -I${SHADER_INCLUDE_DIR} ${defines} --depfile ${raw}.d -o ${raw} ${source}
        DEPENDS ${source} DEPFILE ${raw}.d COMMENT "glslang ${name}" VERBATIM)
    # The optimizer would drop bindings that a specialization leaves unused, and with them the order of a dispatch's buffers.
    add_custom_command(OUTPUT ${module}
        COMMAND ${SPIRV_OPT} -O --preserve-bindings --preserve-spec-constants ${raw} -o ${module}
        COMMAND ${SPIRV_VAL} --target-env vulkan1.1 ${module}
        DEPENDS ${raw} COMMENT "spirv-opt ${name}" VERBATIM)
    set_property(GLOBAL APPEND PROPERTY ${shader_target}_names ${name})
    string(JOIN " " flat_defines ${arg_DEFINES})
    set_property(GLOBAL APPEND PROPERTY ${shader_target}_rows "\"${file}\", \"${flat_defines}\"")
    set_property(GLOBAL APPEND PROPERTY ${shader_target}_modules ${module})
endfunction()

function(shader_library target)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "TABLE;ACCESSOR" "")
    set(shader_target ${target})
    get_filename_component(shader_source_dir ${arg_TABLE} DIRECTORY)
    file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/spirv/raw)
    include(${arg_TABLE})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${arg_TABLE})
    get_property(names GLOBAL PROPERTY ${target}_names)
    get_property(modules GLOBAL PROPERTY ${target}_modules)
    get_property(sources GLOBAL PROPERTY ${target}_rows)

    # The assembler takes in the binaries as they are; the C++ file next to it names them.
    set(assembly "    .section .rodata\n")
    set(declarations "")
    set(rows "")
    set(index 0)
    foreach(name module source IN ZIP_LISTS names modules sources)
        set(symbol ${target}_${index})
        string(APPEND assembly
            "    .balign 4\n    .globl ${symbol}_begin\n    .globl ${symbol}_end\n"
            "${symbol}_begin:\n    .incbin \"${module}\"\n${symbol}_end:\n")
        string(APPEND declarations "extern \"C\" const uint32_t ${symbol}_begin[], ${symbol}_end[];\n")
        string(APPEND rows "        {\"${name}\", {${symbol}_begin, ${symbol}_end}, ${source}},\n")
        math(EXPR index "${index} + 1")
    endforeach()
    string(APPEND assembly "    .section .note.GNU-stack,\"\",%progbits\n")
    file(CONFIGURE OUTPUT ${target}.S CONTENT "${assembly}" @ONLY)
    file(CONFIGURE OUTPUT ${target}.cpp CONTENT
"// Generated from the kernel table.
#include \"shaders-spirv/embedded.h\"

#include <vector>

${declarations}
namespace shaders {

std::span<const Module> ${arg_ACCESSOR}() {
    static const std::vector<Module> kModules = {
${rows}    };
    return kModules;
}

} // namespace shaders
" @ONLY)
    set_source_files_properties(${CMAKE_CURRENT_BINARY_DIR}/${target}.S PROPERTIES OBJECT_DEPENDS "${modules}")
    set_source_files_properties(${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp PROPERTIES SKIP_LINTING ON)
    add_library(${target} STATIC ${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp ${CMAKE_CURRENT_BINARY_DIR}/${target}.S)
    target_link_libraries(${target} PUBLIC brittle_options)
endfunction()
