// A kernel that is written for one subgroup size is found by running it at another.
#include "tests/engine/test_device.h"

#include <gtest/gtest.h>

namespace shaders {
std::span<const Module> deviceTestKernels();
}

namespace {

constexpr uint32_t kCount = 64;

// The first lane of every other eight is set.
std::vector<uint32_t> inputs() {
    std::vector<uint32_t> values(kCount);
    for (uint32_t i = 0; i < kCount; i += 16)
        values[i] = 1;
    return values;
}

std::vector<uint32_t> anyOfEight(const std::vector<uint32_t>& values) {
    std::vector<uint32_t> any(values.size());
    for (size_t i = 0; i < values.size(); ++i)
        for (size_t k = 0; k < 8; ++k)
            any[i] |= values[i / 8 * 8 + k];
    return any;
}

TEST(SubgroupSize, OtherThanTheOneAKernelIsWrittenForIsFoundByItsOracle) {
    engine::Device& device = engine_test::device();
    if (!device.features().subgroup_vote) GTEST_SKIP() << "the device has no subgroup votes";
    engine::KernelLibrary kernels(device, shaders::deviceTestKernels());
    const auto kernel = kernels.get("eight_lanes");
    ASSERT_TRUE(kernel) << kernel.error().message;
    const engine::Buffer values = engine_test::upload(device, inputs()), any = engine_test::readback(device, kCount);
    engine::Commands commands(device);
    ASSERT_TRUE(commands.begin());
    commands.dispatchGroups(**kernel, 1, engine::NoPush{}, {values, any});
    engine_test::finish(commands);
    const bool agrees = engine_test::wordsOf(any) == anyOfEight(inputs());
    EXPECT_EQ(agrees, device.subgroupSize() == 8) << "with subgroups of " << device.subgroupSize();
}

} // namespace
