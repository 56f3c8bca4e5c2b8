#include "tests/kernel/lab.h"

#include <cstdio>
#include <cstdlib>
#include <memory>

namespace kernel_test {
namespace {

// One library for the kernels of the project, one for those of the tests. Both go before their device does.
class Libraries : public testing::Environment {
public:
    engine::KernelLibrary& get(bool of_tests) {
        std::unique_ptr<engine::KernelLibrary>& library = libraries_[of_tests];
        const auto modules = of_tests ? shaders::kernelTestKernels() : shaders::all();
        if (library) return *library;
        library = std::make_unique<engine::KernelLibrary>(engine_test::device(), modules);
        return *library;
    }
    const engine::Kernel& find(bool of_tests, std::string_view name, std::span<const uint32_t> spec) {
        const auto kernel = get(of_tests).get(name, spec);
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

engine::KernelLibrary& kernels() { return libraries.get(false); }

const engine::Kernel& kernel(std::string_view name, std::initializer_list<uint32_t> spec) {
    return libraries.find(false, name, {spec.begin(), spec.size()});
}

const engine::Kernel& testKernel(std::string_view name) { return libraries.find(true, name, {}); }

void Counts::publish(engine::Commands& commands, uint32_t index, uint32_t room) const {
    commands.dispatchGroups(kernel("publish_count"), 1, Word2{index, room}, {words, args});
}

void scan(engine::Commands& commands, const Counts& counts, uint32_t length, const engine::Buffer& values,
          const engine::Buffer& sums, const engine::Buffer& offsets, bool four_channels, const Word4& published) {
    struct ApplyPush {
        uint32_t length, length_count, pad[2];
        Word4 published, capacity;
    };
    constexpr uint32_t kNone = NO_INDEX;
    const uint32_t blocks = (length + SCAN_BLOCK - 1) / SCAN_BLOCK;
    commands.dispatchGroups(kernel(four_channels ? "scan_reduce4" : "scan_reduce"), blocks, Word2{length, kNone},
                            {counts.words, values, sums});
    commands.dispatchGroups(kernel(four_channels ? "scan_apply4" : "scan_apply"), blocks,
                            ApplyPush{length, kNone, {0, 0}, published, {kNone, kNone, kNone, kNone}},
                            {counts.words, values, sums, offsets, counts.args});
}

} // namespace kernel_test
