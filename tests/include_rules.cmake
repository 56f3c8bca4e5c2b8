# Who may include whom. Run as a script: cmake -DSOURCE_DIR=... -P include_rules.cmake
cmake_policy(VERSION 3.25)

# rule(FOLDER REGEX WHY [EXCEPT file...]): no include line of the folder's sources may match.
function(rule folder regex why)
    cmake_parse_arguments(PARSE_ARGV 3 arg "" "" "EXCEPT")
    file(GLOB_RECURSE files RELATIVE ${SOURCE_DIR} ${SOURCE_DIR}/${folder}/*.h ${SOURCE_DIR}/${folder}/*.cpp
        ${SOURCE_DIR}/${folder}/*.comp ${SOURCE_DIR}/${folder}/*.glsl ${SOURCE_DIR}/${folder}/*.vert ${SOURCE_DIR}/${folder}/*.frag)
    foreach(file ${files})
        file(STRINGS ${SOURCE_DIR}/${file} lines REGEX "^[ ]*#[ ]*include[ ]+[<\"](${regex})")
        if(lines AND NOT file IN_LIST arg_EXCEPT)
            message(SEND_ERROR "${file}: ${why}: ${lines}")
        endif()
    endforeach()
endfunction()

# `precise` does not keep drivers from fusing the built-in products; lib/rounded_alike.glsl has products that cannot be fused.
# Left are heights of colliders and orders at less than exact precision.
file(GLOB_RECURSE kernel_sources RELATIVE ${SOURCE_DIR} ${SOURCE_DIR}/shaders-spirv/*.comp ${SOURCE_DIR}/shaders-spirv/*.glsl)
foreach(file ${kernel_sources})
    file(STRINGS ${SOURCE_DIR}/${file} lines REGEX "^ *precise .*[^A-Za-z](cross|dot)\\(")
    if(lines AND NOT file MATCHES "(order_triples.comp|write_collider.glsl)$")
        message(SEND_ERROR "${file}: a precise value from the built-in cross or dot, which drivers may fuse: ${lines}")
    endif()
endforeach()

rule(shaders-spirv/shared "(engine|modules|tools|tests)/" "shared headers stand alone")
rule(shaders-spirv "(engine|modules|tools|tests)/" "kernels know only shared headers and lib")
rule(engine "(modules|tools|tests)/" "the engine knows no module")
rule(engine "shaders-spirv/shared/(fracture|fragment)" "the engine knows no fracture")
rule(engine "(glslang|spirv-tools)/" "only the two that compile see a compiler" EXCEPT engine/reload/glsl_compiler.cpp
    engine/reload/include_finder.h)
rule(modules "(tools|tests)/" "modules know no program")
rule(modules "engine/(module|frame)" "only register_module meets the engine's registry"
    EXCEPT modules/brittle/register_module.h modules/brittle/register_module.cpp)
rule(modules/brittle/mesh "(volk|vulkan)" "the mesh knows no Vulkan")
rule(modules "assimp/" "only mesh/read_assimp sees assimp" EXCEPT modules/brittle/mesh/read_assimp.cpp)
rule(modules "meshoptimizer" "only gltf/meshopt sees meshoptimizer" EXCEPT modules/brittle/mesh/gltf/meshopt.cpp)
rule(modules "draco/" "only gltf/draco sees Draco" EXCEPT modules/brittle/mesh/gltf/draco.cpp)
rule(modules "toml\\+\\+/" "only read_scene sees toml++" EXCEPT modules/brittle/scene/read_scene.cpp)
rule(modules "libqhull" "only qhull_faces sees Qhull" EXCEPT modules/brittle/scene/hull/qhull_faces.cpp)
rule(modules/brittle/godot "(engine/|shaders-spirv/|volk|vulkan|modules/brittle/[a-fh-z][a-z_]*/)" "plugins know nothing but the C ABI")
rule(modules/brittle/scene "(volk|vulkan)" "a scene has met no device")
rule(tests/reference "(engine|modules/brittle/(fracture|export))|shaders-spirv" "an oracle shares no code with what it checks")
