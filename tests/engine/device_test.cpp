#include "engine/arena.h"
#include "tests/engine/test_device.h"

#include <cctype>
#include <gtest/gtest.h>
#include <thread>

using namespace engine;
using namespace engine_test;

TEST(Devices, AreFoundByIndexAndByAPartOfTheirName) {
    for (const DeviceInfo& info : listDevices()) {
        if (!info.usable) continue;
        DeviceOptions options;
        options.select = std::to_string(info.index);
        const auto by_index = Device::create(options);
        ASSERT_TRUE(by_index);
        EXPECT_EQ((*by_index)->name(), info.name);
        EXPECT_EQ((*by_index)->isCpu(), info.cpu);
        options.select = info.name.substr(0, 5);
        options.select[0] = static_cast<char>(std::toupper(options.select[0]));
        EXPECT_TRUE(Device::create(options));
    }
}

TEST(Devices, MinimalOnesHaveNothingOptional) {
    const OptionalFeatures& f = minimalDevice().features();
    EXPECT_FALSE(f.push_descriptors || f.multi_draw_indirect || f.draw_indirect_first_instance || f.shader_stores);
    EXPECT_FALSE(pooledDevice().hasPushDescriptors());
    EXPECT_GE(device().subgroupSize(), 1u);
    EXPECT_GE(device().limits().maxPushConstantsSize, 128u);
}

TEST(Devices, CountWhatTheValidationLayersSay) {
    if (!validationIsOn()) GTEST_SKIP() << "without VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation nothing is said";
    expectValidationMessages(1);
    const uint32_t before = device().validationMessageCount();
    VkFenceCreateInfo wrong{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    wrong.flags = 0x40;
    VkFence fence = VK_NULL_HANDLE;
    device().vk().vkCreateFence(device().handle(), &wrong, nullptr, &fence);
    device().vk().vkDestroyFence(device().handle(), fence, nullptr);
    EXPECT_EQ(device().validationMessageCount(), before + 1);
}

// A write past the end of a range of an arena, which a CPU device would let pass without a word.
TEST(Devices, HearOfWritesPastTheEnd) {
    if (!validationIsOn() || !device().gpuAssistedValidation())
        GTEST_SKIP() << "without GPU-assisted validation nobody would notice";
    expectValidationMessages(1);
    struct Push {
        uint32_t count, factor;
    };
    const Buffer source = scratch(device(), 1024);
    auto arena = ScratchArena::create(device(), 1 << 16);
    ASSERT_TRUE(arena);
    const BufferView target = arena->take(256);
    Commands commands(device());
    ASSERT_TRUE(commands.begin());
    commands.dispatch(testKernel(device(), "add_index"), 65, Push{65, 1}, {source, target});
    finish(commands);
}

TEST(Kernels, AreMadeOnceForEachSetOfConstants) {
    KernelLibrary kernels(device(), shaders::engineTestKernels());
    EXPECT_EQ(kernels.kernelCount(), 0u);
    const auto plain = kernels.get("add_index"), again = kernels.get("add_index"), biased = kernels.get("add_index", {5u});
    ASSERT_TRUE(plain && again && biased);
    EXPECT_EQ(*plain, *again);
    EXPECT_NE(*plain, *biased);
    EXPECT_EQ(kernels.kernelCount(), 2u);
    EXPECT_GT(kernels.creationMs(), 0.0);
}

TEST(Kernels, AreMadeSideBySide) {
    KernelLibrary kernels(device(), shaders::engineTestKernels());
    std::vector<KernelRequest> requests = {{"increment", {}}, {"write_args", {}}, {"count_once", {}}};
    for (uint32_t bias = 0; bias < 20; ++bias)
        requests.push_back({"add_index", {bias % 10}}); // each wished for twice
    {
        const std::jthread other([&] { EXPECT_TRUE(kernels.warm(requests)); });
        EXPECT_TRUE(kernels.warm(requests));
    }
    EXPECT_EQ(kernels.kernelCount(), 13u);
}

TEST(Kernels, ConstantsAndDefinesMakeVariants) {
    struct Push {
        uint32_t count, factor;
    };
    const Buffer source = upload(device(), {100}), one = readback(device(), 1), two = readback(device(), 1);
    Commands commands(device());
    ASSERT_TRUE(commands.begin());
    commands.dispatch(testKernel(device(), "add_index", {11u}), 1, Push{1, 0}, {source, one});
    commands.dispatch(testKernel(device(), "add_index_twice"), 1, Push{1, 0}, {source, two});
    finish(commands);
    EXPECT_EQ(wordsOf(one)[0], 111u);
    EXPECT_EQ(wordsOf(two)[0], 200u);
}

TEST(Shaders, AreFoundByName) {
    for (const shaders::Module& module : shaders::all()) {
        ASSERT_NE(shaders::find(module.name), nullptr);
        EXPECT_EQ(shaders::find(module.name)->words.data(), module.words.data());
        EXPECT_TRUE(reflect(module.words)) << module.name;
    }
    EXPECT_EQ(shaders::find("no such kernel"), nullptr);
}

TEST(Timestamps, AddUpByLabel) {
    const Buffer words = scratch(device(), 1 << 20);
    Commands commands(device());
    for (int round = 0; round < 2; ++round) {
        ASSERT_TRUE(commands.begin());
        for (const char* label : {"first", "second", "first"}) {
            commands.beginLabel(label);
            commands.dispatch(testKernel(device(), "increment"), 1 << 20, NoPush{}, {words});
            commands.endLabel();
        }
        commands.beginLabel("nothing");
        commands.endLabel();
        finish(commands);
        const auto timings = commands.timings();
        ASSERT_TRUE(timings);
        if (device().computeQueue().timestamp_bits == 0) GTEST_SKIP() << "a queue without timestamps";
        ASSERT_EQ(timings->size(), 3u);
        EXPECT_EQ((*timings)[0].name, "first");
        EXPECT_EQ((*timings)[0].count, 2u);
        EXPECT_EQ((*timings)[1].count, 1u);
        EXPECT_GT((*timings)[0].ms, 0.0);
        EXPECT_GT((*timings)[1].ms, (*timings)[2].ms);
    }
}

TEST(Timestamps, OutgrowOnePool) {
    Commands commands(device());
    ASSERT_TRUE(commands.begin());
    for (int i = 0; i < 700; ++i) {
        commands.beginLabel(i % 2 == 0 ? "even" : "odd");
        commands.endLabel();
    }
    finish(commands);
    const auto timings = commands.timings();
    ASSERT_TRUE(timings);
    ASSERT_EQ(timings->size(), 2u);
    EXPECT_EQ((*timings)[0].count + (*timings)[1].count, 700u);
}
