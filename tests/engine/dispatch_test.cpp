#include "engine/kernel_twin.h"
#include "engine/kernel_warmup.h"
#include "tests/engine/test_device.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace engine;
using namespace engine_test;

namespace {

struct AddIndexPush {
    uint32_t count, factor;
};

// target[i] = source[i] + 3 i + 7, with source[i] = 1000 + i.
std::vector<uint32_t> addIndex(Device& device, uint32_t count) {
    const Buffer source = upload(device, countingFrom(1000, count)), target = readback(device, count);
    Commands commands(device);
    EXPECT_TRUE(commands.begin());
    commands.dispatch(testKernel(device, "add_index", {7u}), count, AddIndexPush{count, 3}, {source, target});
    finish(commands);
    return wordsOf(target);
}

std::vector<uint32_t> addIndexExpected(uint32_t count) {
    std::vector<uint32_t> words(count);
    for (uint32_t i = 0; i < count; ++i)
        words[i] = 1007 + 4 * i;
    return words;
}

} // namespace

TEST(Dispatch, GivesTheSameOnEveryKindOfDevice) {
    for (Device* device : allDevices()) {
        for (const uint32_t count : {1u, 63u, 64u, 65u, 1234u, 100000u})
            EXPECT_EQ(addIndex(*device, count), addIndexExpected(count)) << count;
    }
}

TEST(Dispatch, OfNothingRecordsNothing) {
    const Buffer words = upload(device(), {41});
    Commands commands(device());
    ASSERT_TRUE(commands.begin());
    commands.dispatch(testKernel(device(), "increment"), 0, NoPush{}, {words});
    commands.dispatchGroups(testKernel(device(), "increment"), 0, NoPush{}, {words});
    EXPECT_EQ(commands.dispatchCount(), 0u);
    finish(commands);
    EXPECT_EQ(wordsOf(words)[0], 41u);
}

TEST(Dispatch, ATraceTellsWhatWasRecordedInOrder) {
    const Buffer words = scratch(device(), 256);
    const BufferView all = words, args = all.sub(768, 12);
    Commands commands(device());
    ASSERT_TRUE(commands.begin());
    commands.dispatch(testKernel(device(), "increment"), 5, NoPush{}, {words});
    EXPECT_TRUE(commands.trace().empty()) << "nobody has asked yet";
    commands.keepTrace();
    commands.fill(words, 0);
    commands.beginLabel("first");
    commands.dispatch(testKernel(device(), "increment"), 100, NoPush{}, {all.sub(0, 256)});
    commands.dispatchGroups(testKernel(device(), "increment"), 3, NoPush{}, {words});
    commands.endLabel();
    commands.dispatchIndirect(testKernel(device(), "increment"), args, NoPush{}, {all.sub(0, 256)});
    commands.copy(all.sub(0, 16), all.sub(32, 16));
    finish(commands);
    using Kind = TracedCommand::Kind;
    const auto trace = commands.trace();
    ASSERT_EQ(trace.size(), 5u);
    const Kind kinds[] = {Kind::Fill, Kind::Lanes, Kind::Groups, Kind::Indirect, Kind::Copy};
    for (size_t k = 0; k < 5; ++k)
        EXPECT_EQ(trace[k].kind, kinds[k]) << k;
    EXPECT_EQ(trace[0].kernel, nullptr);
    EXPECT_EQ(trace[1].kernel->name, "increment");
    EXPECT_EQ(trace[1].label, "first");
    EXPECT_EQ(trace[1].count, 100u);
    EXPECT_EQ(trace[1].buffers.at(0).size, 256u);
    EXPECT_EQ(trace[2].count, 3u);
    EXPECT_EQ(trace[3].label, "");
    EXPECT_EQ(trace[3].arguments.offset, 768u);
    EXPECT_EQ(trace[4].buffers.at(1).offset, 32u);
}

TEST(Dispatch, BindsSixteenBuffers) {
    for (Device* device : allDevices()) {
        const Buffer word = upload(*device, {3}), sum = readback(*device, 1);
        Commands commands(*device);
        ASSERT_TRUE(commands.begin());
        commands.dispatch(testKernel(*device, "many_buffers"), 1, NoPush{},
                          {word, word, word, word, word, word, word, word, word, word, word, word, word, word, word, sum});
        finish(commands);
        EXPECT_EQ(wordsOf(sum)[0], 45u);
    }
}

// More workgroups than one dimension holds, once a little and once by several rows: every index is visited once, and less
// than one row's worth of indices lies past the end.
TEST(Dispatch, VisitsEveryIndexOnceBeyondOneDimension) {
    for (Device* device : allDevices()) {
        for (const uint32_t count : {65535u, 65536u, 200001u}) {
            const Buffer visits = readback(*device, count + 1);
            Commands commands(*device);
            ASSERT_TRUE(commands.begin());
            commands.fill(visits, 0);
            commands.dispatch(testKernel(*device, "count_once"), count, count, {visits});
            finish(commands);
            const std::vector<uint32_t> words = wordsOf(visits);
            EXPECT_EQ(std::count(words.begin(), words.begin() + count, 1u), count);
            EXPECT_LT(words[count], 4u);
        }
    }
}

TEST(Dispatch, IndirectTakesItsSizeFromTheDevice) {
    for (Device* device : allDevices()) {
        for (const uint32_t groups : {0u, 1u, 3u}) {
            const Buffer words = upload(*device, countingFrom(0, 256)), args = scratch(*device, 64);
            const BufferView third = BufferView(args).sub(8, 12);
            Commands commands(*device);
            ASSERT_TRUE(commands.begin());
            commands.dispatch(testKernel(*device, "write_args"), 1, uint32_t{99}, {args});
            const uint32_t sizes[] = {groups, 1, 1};
            const Buffer given = upload(*device, {sizes, sizes + 3});
            commands.copy(given, third);
            commands.dispatchIndirect(testKernel(*device, "increment"), third, NoPush{}, {words});
            finish(commands);
            const std::vector<uint32_t> result = wordsOf(words);
            for (uint32_t i = 0; i < 256; ++i)
                ASSERT_EQ(result[i], i + (i < 64 * groups ? 1 : 0));
        }
    }
}

TEST(Dispatch, RecordsIntoTheCallersCommandBuffer) {
    Device& d = device();
    VkCommandPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool_info.queueFamilyIndex = d.computeQueue().family;
    VkCommandPool pool = VK_NULL_HANDLE;
    ASSERT_EQ(d.vk().vkCreateCommandPool(d.handle(), &pool_info, nullptr, &pool), VK_SUCCESS);
    const VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool,
                                           VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
    VkCommandBuffer theirs = VK_NULL_HANDLE;
    ASSERT_EQ(d.vk().vkAllocateCommandBuffers(d.handle(), &info, &theirs), VK_SUCCESS);
    const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    ASSERT_EQ(d.vk().vkBeginCommandBuffer(theirs, &begin), VK_SUCCESS);

    const Buffer words = upload(d, {1, 2, 3});
    Commands commands(d, theirs);
    commands.beginLabel("increment");
    commands.dispatch(testKernel(d, "increment"), 3, NoPush{}, {words});
    commands.endLabel();
    commands.flush();
    EXPECT_TRUE(commands.status());
    ASSERT_EQ(d.vk().vkEndCommandBuffer(theirs), VK_SUCCESS);
    ASSERT_TRUE(d.submit(d.computeQueue(), theirs, VK_NULL_HANDLE));
    d.waitIdle();
    EXPECT_EQ(wordsOf(words), (std::vector<uint32_t>{2, 3, 4}));
    EXPECT_EQ(commands.timings()->size(), 1u);
    d.vk().vkDestroyCommandPool(d.handle(), pool, nullptr);
}

TEST(Dispatch, FollowsMoreRecordingsThanOnePoolOfDescriptors) {
    Device& d = pooledDevice();
    const Buffer words = upload(d, {0});
    Commands commands(d);
    for (int round = 0; round < 2; ++round) {
        ASSERT_TRUE(commands.begin());
        for (int i = 0; i < 600; ++i)
            commands.dispatch(testKernel(d, "increment"), 1, NoPush{}, {words});
        EXPECT_EQ(commands.barrierCount(), 599u);
        finish(commands);
    }
    EXPECT_EQ(wordsOf(words)[0], 1200u);
}

TEST(Copy, MovesRangesAndFillsThem) {
    const Buffer source = upload(device(), countingFrom(10, 8)), target = readback(device(), 8);
    Commands commands(device());
    ASSERT_TRUE(commands.begin());
    commands.fill(target, 5);
    commands.copy(BufferView(source).sub(8, 12), BufferView(target).sub(4, 12));
    commands.copy({&source, 0, 0}, target);
    finish(commands);
    EXPECT_EQ(wordsOf(target), (std::vector<uint32_t>{5, 12, 13, 14, 5, 5, 5, 5}));
}

// Seen from the host, which counts the workgroups, and from the kernel.
TEST(KernelLibrary, SetsTheSizeOfWorkgroupsForKernelsThatLeaveItOpen) {
    for (const uint32_t size : {8u, 16u, 128u}) {
        KernelLibrary library(device(), shaders::engineTestKernels(), {{100, size}});
        const auto sized = library.get("sized_workgroup"), fixed = library.get("increment");
        ASSERT_TRUE(sized && fixed);
        EXPECT_EQ((*sized)->reflection.local_size[0], size);
        EXPECT_EQ((*fixed)->reflection.local_size[0], 64u);
        const Buffer words = upload(device(), std::vector<uint32_t>(400, 5));
        Commands commands(device());
        ASSERT_TRUE(commands.begin());
        commands.dispatch(**sized, 129, NoPush{}, {words});
        finish(commands);
        const uint32_t lanes = (129 + size - 1) / size * size;
        for (uint32_t k = 0; k < 400; ++k)
            ASSERT_EQ(wordsOf(words)[k], k < lanes ? 7000 + size : 5u) << k;
    }
}

TEST(KernelLibrary, SetsConstantsAskedForByPlaceNextToThoseInCommon) {
    KernelLibrary library(device(), shaders::engineTestKernels(), {{100, 32}, {3, 4}});
    const Buffer words = upload(device(), std::vector<uint32_t>(64, 5));
    for (const auto& [spec, other] :
         {std::pair(std::vector<uint32_t>{}, 4u), std::pair(std::vector<uint32_t>{0, 0, 0, 9}, 9u)}) {
        const auto kernel = library.get("sized_workgroup", spec);
        ASSERT_TRUE(kernel);
        Commands commands(device());
        ASSERT_TRUE(commands.begin());
        commands.dispatch(**kernel, 1, NoPush{}, {words});
        finish(commands);
        EXPECT_EQ(wordsOf(words)[31], 1000 * other + 32);
        EXPECT_EQ(wordsOf(words)[32], 5u);
    }
}

TEST(KernelLibrary, RefusesWorkgroupsThatTheDeviceDoesNotTake) {
    for (const uint32_t size : {0u, 1u << 20}) {
        KernelLibrary library(device(), shaders::engineTestKernels(), {{100, size}});
        const auto refused = library.get("sized_workgroup");
        ASSERT_FALSE(refused);
        EXPECT_NE(refused.error().message.find("a workgroup of " + std::to_string(size) + " lanes"), std::string::npos)
            << refused.error().message;
    }
}

TEST(KernelWarmup, LeavesKernelsAsUsableAsWithoutIt) {
    KernelLibrary library(device(), shaders::engineTestKernels());
    {
        KernelWarmup warmup(device(), library, {"increment", "no kernel of ours", "add_index"});
        warmup.finish();
    }
    auto increment = library.get("increment");
    ASSERT_TRUE(increment);
    const Buffer words = upload(device(), {41});
    Commands commands(device());
    ASSERT_TRUE(commands.begin());
    commands.dispatch(**increment, 1, NoPush{}, {words});
    finish(commands);
    EXPECT_EQ(wordsOf(words)[0], 42u);
}

// In a cache of its own, in which the library's kernels then are.
TEST(LateWarmup, CompilesOnATwinWhatALibraryHasAskedFor) {
    if (!KernelTwin::helps(device())) GTEST_SKIP() << "this device compiles when pipelines are made";
    KernelLibrary library(device(), shaders::engineTestKernels());
    ASSERT_TRUE(library.get("increment") && library.get("add_index", {7u}));
    const auto folder = std::filesystem::temp_directory_path() / ("brittle_late_warmup_" + std::to_string(getpid()));
    const char* before = std::getenv("MESA_SHADER_CACHE_DIR");
    const std::string usual = before != nullptr ? before : "";
    ASSERT_EQ(setenv("MESA_SHADER_CACHE_DIR", folder.c_str(), 1), 0);
    LateWarmup(device(), library, std::chrono::milliseconds(0)).finish();
    before != nullptr ? setenv("MESA_SHADER_CACHE_DIR", usual.c_str(), 1) : unsetenv("MESA_SHADER_CACHE_DIR");
    size_t files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        files += entry.is_regular_file() ? 1 : 0;
    EXPECT_GT(files, 0u);
    std::filesystem::remove_all(folder);
}

TEST(LateWarmup, ThatIsStoppedInTimeBeginsNothing) {
    KernelLibrary library(device(), shaders::engineTestKernels());
    ASSERT_TRUE(library.get("increment"));
    const auto start = std::chrono::steady_clock::now();
    {
        LateWarmup warmup(device(), library, std::chrono::hours(1));
        warmup.stop();
    }
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::minutes(1));
}

TEST(KernelWarmup, EndsWhenItIsNoLongerWanted) {
    KernelLibrary library(device(), shaders::engineTestKernels());
    const KernelWarmup warmup(device(), library, std::vector<std::string_view>(1000, "increment"));
}
