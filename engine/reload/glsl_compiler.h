// GLSL to SPIR-V within this process, as the build makes it: by glslang for Vulkan 1.1, optimized and validated by SPIRV-Tools,
// with the same settings (shaders-spirv/shader_library.cmake), so that the same source gives the same words.
#pragma once

#include "engine/reload/diagnostic.h"

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace engine {

// A kernel as a row of a table of kernels names it.
struct KernelSource {
    std::string name;
    std::filesystem::path file;       // .comp, .vert or .frag, which is its stage
    std::vector<std::string> defines; // "NAME" or "NAME=VALUE"
};

struct CompiledKernel {
    std::vector<uint32_t> words; // empty where there is an error
    std::vector<Diagnostic> diagnostics;
    std::set<std::filesystem::path> files; // all that was read, and all that was looked for first and may yet appear
    bool good() const { return !words.empty(); }
};

// What any compilation needs that is made only once. A process that is forked after it has been made has it, too.
void prepareCompiler();

// Includes in quotes are looked for next to the file that names them, then next to the files that include that one, then in
// `include_folders`, in order. Safe from any thread.
CompiledKernel compileGlsl(const KernelSource& source, const std::vector<std::filesystem::path>& include_folders);

// The source with its includes and macros put in, with "#line" at every change of file; empty where that cannot be done.
std::string preprocessGlsl(const KernelSource& source, const std::vector<std::filesystem::path>& include_folders);

} // namespace engine
