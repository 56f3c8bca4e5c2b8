#include "engine/arena.h"
#include "tests/engine/test_device.h"

#include <cstring>
#include <gtest/gtest.h>

using namespace engine;
using namespace engine_test;

namespace {

// A device of its own, so that the blocks are only those of the test.
std::unique_ptr<Device> ownDevice() {
    auto made = Device::create();
    EXPECT_TRUE(made);
    return std::move(*made);
}

Buffer bufferOf(Device& device, VkDeviceSize bytes) {
    auto made = Buffer::create(device, bytes, BufferDomain::Upload);
    EXPECT_TRUE(made) << (made ? "" : made.error().message);
    return std::move(*made);
}

} // namespace

TEST(Buffers, ShareABlockOfMemoryWithoutTouchingEachOther) {
    const auto device = ownDevice();
    std::vector<Buffer> buffers;
    for (unsigned i = 0; i < 200; ++i) {
        buffers.push_back(bufferOf(*device, 100 + 40 * i));
        std::memset(buffers[i].mapped(), static_cast<int>(i), buffers[i].size());
    }
    const VkDeviceSize allocated = device->memory().allocatedBytes();
    for (unsigned i = 0; i < 200; i += 2)
        buffers[i] = bufferOf(*device, 60 + i);
    for (unsigned i = 0; i < 200; i += 2)
        std::memset(buffers[i].mapped(), static_cast<int>(i), buffers[i].size());
    for (unsigned i = 0; i < 200; ++i) {
        for (VkDeviceSize at = 0; at < buffers[i].size(); ++at)
            ASSERT_EQ(std::to_integer<unsigned>(buffers[i].mapped()[at]), i);
    }
    EXPECT_EQ(device->memory().allocatedBytes(), allocated);
}

TEST(Buffers, AreCountedByWhatTheyTake) {
    const auto device = ownDevice();
    const VkDeviceSize before = device->memory().takenBytes();
    {
        const Buffer a = bufferOf(*device, 1000), b = bufferOf(*device, VkDeviceSize(50) << 20);
        const VkDeviceSize taken = device->memory().takenBytes() - before;
        EXPECT_GE(taken, a.size() + b.size());
        EXPECT_LE(taken, a.size() + b.size() + 2 * 256);
    }
    EXPECT_EQ(device->memory().takenBytes(), before);
}

TEST(Buffers, GiveTheirMemoryBack) {
    const auto device = ownDevice();
    const VkDeviceSize before = device->memory().allocatedBytes();
    for (int i = 0; i < 3; ++i) {
        const Buffer large = bufferOf(*device, VkDeviceSize(100) << 20);
        EXPECT_GE(device->memory().allocatedBytes(), before + large.size());
    }
    EXPECT_EQ(device->memory().allocatedBytes(), before);
    for (int i = 0; i < 100; ++i)
        bufferOf(*device, VkDeviceSize(20) << 20);
    EXPECT_LE(device->memory().allocatedBytes(), VkDeviceSize(32) << 20);
}

TEST(Buffers, RefuseNothingAndTooMuch) {
    EXPECT_FALSE(Buffer::create(device(), 0, BufferDomain::Device));
    const auto huge = Buffer::create(device(), VkDeviceSize(1) << 46, BufferDomain::Device, 0, "everything");
    ASSERT_FALSE(huge);
    EXPECT_NE(huge.error().message.find("everything"), std::string::npos) << huge.error().message;
}

TEST(Arena, SharesMemoryBetweenDisjointLifetimes) {
    auto arena = ScratchArena::create(device(), 4096);
    ASSERT_TRUE(arena);
    const BufferView kept = arena->take(100);
    const ScratchArena::Mark mark = arena->mark();
    const BufferView first = arena->take(1000);
    arena->release(mark);
    const BufferView second = arena->take(500);
    if (!device().gpuAssistedValidation()) {
        EXPECT_EQ(first.offset, second.offset);
        EXPECT_EQ(first.buffer, second.buffer);
        EXPECT_GE(second.offset, kept.offset + kept.size);
    }
    EXPECT_EQ(second.offset % 256, 0u);
    EXPECT_EQ(second.size, 512u) << "whole fours of words";
    EXPECT_GE(arena->peak(), 1256u);
    EXPECT_LT(arena->used(), arena->peak());
    EXPECT_TRUE(arena->status());
}

// What shares memory is kept apart by the barriers: the second user overwrites what the first has finished reading.
TEST(Arena, ReusedMemoryIsSynchronized) {
    struct Push {
        uint32_t count, factor;
    };
    auto arena = ScratchArena::create(device(), 1 << 20);
    ASSERT_TRUE(arena);
    const Buffer source = upload(device(), countingFrom(0, 4096));
    const Buffer one = readback(device(), 4096), two = readback(device(), 4096);
    const Kernel& add = testKernel(device(), "add_index");
    Commands commands(device());
    ASSERT_TRUE(commands.begin());
    const BufferView first = arena->take(source.size());
    commands.dispatch(add, 4096, Push{4096, 1}, {source, first});
    commands.dispatch(add, 4096, Push{4096, 0}, {first, one});
    arena->release(0);
    const BufferView second = arena->take(source.size());
    commands.dispatch(add, 4096, Push{4096, 2}, {source, second});
    commands.copy(second, two);
    finish(commands);
    EXPECT_EQ(first.offset, second.offset);
    EXPECT_EQ(wordsOf(one)[4095], 2u * 4095);
    EXPECT_EQ(wordsOf(two)[4095], 3u * 4095);
}

TEST(Arena, SaysHowMuchWouldHaveBeenNeeded) {
    auto arena = ScratchArena::create(device(), 1024, "pool of the test");
    ASSERT_TRUE(arena);
    EXPECT_NE(arena->take(1000).buffer, nullptr);
    EXPECT_EQ(arena->take(1000).buffer, nullptr);
    EXPECT_EQ(arena->take(10).buffer, nullptr);
    const auto status = arena->status();
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, ErrorCode::Capacity);
    EXPECT_NE(status.error().message.find("pool of the test"), std::string::npos);
    EXPECT_NE(status.error().message.find("1024"), std::string::npos);
    EXPECT_NE(status.error().message.find("2064"), std::string::npos) << status.error().message;
    arena->reset();
    EXPECT_TRUE(arena->status());
    EXPECT_NE(arena->take(0).buffer, nullptr);
}

TEST(Arena, StaysValidWhenMoved) {
    auto made = ScratchArena::create(device(), 1024);
    ASSERT_TRUE(made);
    ScratchArena arena = std::move(*made);
    const BufferView view = arena.take(64);
    const ScratchArena moved = std::move(arena);
    EXPECT_EQ(view.buffer->size(), device().gpuAssistedValidation() ? 64u : moved.capacity());
}
