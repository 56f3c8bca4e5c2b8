#include "tests/kernel/lab.h"

#include <cstdio>
#include <cstdlib>
#include <memory>

namespace kernel_test {
namespace {

// One library for the kernels of the project, one for those of the tests. Both go before their device does.
class Libraries : public testing::Environment {
public:
    const engine::Kernel& find(bool of_tests, std::string_view name, std::span<const uint32_t> spec) {
        std::unique_ptr<engine::KernelLibrary>& library = libraries_[of_tests];
        const auto modules = of_tests ? shaders::kernelTestKernels() : shaders::all();
        if (!library) library = std::make_unique<engine::KernelLibrary>(engine_test::device(), modules);
        const auto kernel = library->get(name, spec);
        if (!kernel) {
            std::fprintf(stderr, "%s\n", kernel.error().message.c_str());
            std::_Exit(EXIT_FAILURE);
        }
        return **kernel;
    }
    void TearDown() override {
        for (auto& library : libraries_)
            library.reset();
    }

private:
    std::array<std::unique_ptr<engine::KernelLibrary>, 2> libraries_;
};

// googletest owns it.
Libraries& libraries = *static_cast<Libraries*>(testing::AddGlobalTestEnvironment(new Libraries));

} // namespace

const engine::Kernel& kernel(std::string_view name, std::initializer_list<uint32_t> spec) {
    return libraries.find(false, name, {spec.begin(), spec.size()});
}

const engine::Kernel& testKernel(std::string_view name) { return libraries.find(true, name, {}); }

} // namespace kernel_test
