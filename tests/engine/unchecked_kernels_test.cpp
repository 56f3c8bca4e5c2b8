// Kernels that GPU-assisted validation leaves alone.
#include "engine/arena.h"
#include "engine/unchecked_kernels.h"
#include "tests/engine/test_device.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace {

using namespace engine;
using namespace engine_test;

constexpr const char* kVariable = "BRITTLE_UNCHECKED_KERNELS";

// Writes 65 words into a range of 64.
void writePastTheEnd(Device& on) {
    KernelLibrary kernels(on, shaders::engineTestKernels());
    const auto kernel = kernels.get("add_index");
    ASSERT_TRUE(kernel);
    const Buffer source = scratch(on, 1024);
    auto arena = ScratchArena::create(on, 1 << 16);
    ASSERT_TRUE(arena);
    const BufferView target = arena->take(256);
    Commands commands(on);
    ASSERT_TRUE(commands.begin());
    struct Push {
        uint32_t count, factor;
    };
    commands.dispatch(**kernel, 65, Push{65, 1}, {source, target});
    finish(commands);
}

} // namespace

TEST(UncheckedKernels, AreThoseOfTheList) {
    EXPECT_TRUE(isNamedIn("one,two,three", "one"));
    EXPECT_TRUE(isNamedIn("one,two,three", "three"));
    EXPECT_FALSE(isNamedIn("one,two,three", "tw"));
    EXPECT_FALSE(isNamedIn("one,two,three", "one,two"));
    EXPECT_FALSE(isNamedIn("", "one"));
}

TEST(UncheckedKernels, AreNoneWithoutGpuAssistedValidation) {
    if (device().gpuAssistedValidation()) GTEST_SKIP() << "it is on";
    setenv(kVariable, "add_index", 1);
    EXPECT_TRUE(extensionsForUncheckedKernels().empty());
    EXPECT_FALSE(leavesUnchecked(device(), "add_index"));
    unsetenv(kVariable);
}

// Only on a CPU device, which ignores such a write.
TEST(UncheckedKernels, CauseNoMessages) {
    if (!validationIsOn() || !device().gpuAssistedValidation() || !device().isCpu())
        GTEST_SKIP() << "only GPU-assisted validation checks kernels";
    for (const bool unchecked : {false, true}) {
        setenv(kVariable, unchecked ? "increment,add_index" : "increment", 1);
        const auto own = Device::create({.select = device().name()});
        ASSERT_TRUE(own) << own.error().message;
        writePastTheEnd(**own);
        EXPECT_EQ((*own)->validationMessageCount(), unchecked ? 0u : 1u);
    }
    unsetenv(kVariable);
    expectValidationMessages(1);
}
