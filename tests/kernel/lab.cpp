#include "tests/kernel/lab.h"

#include <cstdio>
#include <cstdlib>

namespace kernel_test {
namespace {

const engine::Kernel& found(engine::KernelLibrary& library, std::string_view name, std::span<const uint32_t> spec) {
    const auto kernel = library.get(name, spec);
    if (!kernel) {
        std::fprintf(stderr, "%s\n", kernel.error().message.c_str());
        std::exit(EXIT_FAILURE);
    }
    return **kernel;
}

} // namespace

const engine::Kernel& kernel(std::string_view name, std::initializer_list<uint32_t> spec) {
    static engine::KernelLibrary library(engine_test::device());
    return found(library, name, {spec.begin(), spec.size()});
}

const engine::Kernel& testKernel(std::string_view name) {
    static engine::KernelLibrary library(engine_test::device(), shaders::kernelTestKernels());
    return found(library, name, {});
}

} // namespace kernel_test
