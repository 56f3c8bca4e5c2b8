#include "engine/hazards.h"
#include "tests/engine/test_device.h"

#include <gtest/gtest.h>

using namespace engine;
using namespace engine_test;

namespace {

constexpr uint32_t kCount = 64;
constexpr size_t kWords = 256;

struct AddIndexPush {
    uint32_t count, factor;
};

// Four buffers, and ways to touch them; counts the barriers that a recording has needed.
class Recording {
public:
    Recording() : a(scratch(device(), kWords)), b(scratch(device(), kWords)), c(scratch(device(), kWords)), commands(device()) {
        EXPECT_TRUE(commands.begin());
    }
    void readWrite(BufferView from, BufferView to) {
        commands.dispatch(testKernel(device(), "add_index"), kCount, AddIndexPush{kCount, 1}, {from, to});
    }
    void update(BufferView words) { commands.dispatch(testKernel(device(), "increment"), kCount, NoPush{}, {words}); }
    void updateIndirect(BufferView args, BufferView words) {
        commands.dispatchIndirect(testKernel(device(), "increment"), args, NoPush{}, {words});
    }
    void writeArgs(BufferView args) { commands.dispatch(testKernel(device(), "write_args"), 1, uint32_t{1}, {args}); }
    // Submits as well, so that the synchronization layer sees every sequence.
    uint32_t barriers() {
        const uint32_t count = commands.barrierCount();
        finish(commands);
        return count;
    }
    Buffer a, b, c;
    Commands commands;
};

BufferView half(const Buffer& buffer, VkDeviceSize which) { return BufferView(buffer).sub(which * 512, 512); }

} // namespace

TEST(Barriers, ReadAfterWrite) {
    Recording r;
    r.readWrite(r.a, r.b);
    r.readWrite(r.b, r.c);
    EXPECT_EQ(r.barriers(), 1u);
}

TEST(Barriers, WriteAfterRead) {
    Recording r;
    r.readWrite(r.a, r.b);
    r.readWrite(r.c, r.a);
    EXPECT_EQ(r.barriers(), 1u);
}

TEST(Barriers, WriteAfterWrite) {
    Recording r;
    r.readWrite(r.a, r.b);
    r.readWrite(r.c, r.b);
    EXPECT_EQ(r.barriers(), 1u);
}

TEST(Barriers, UpdatesFollowEachOther) {
    Recording r;
    r.update(r.a);
    r.update(r.a);
    r.update(r.a);
    EXPECT_EQ(r.barriers(), 2u);
}

TEST(Barriers, NoneBetweenReaders) {
    Recording r;
    r.readWrite(r.a, r.b);
    r.readWrite(r.a, r.c);
    EXPECT_EQ(r.barriers(), 0u);
}

TEST(Barriers, NoneBetweenDisjointRangesOfOneBuffer) {
    Recording r;
    r.readWrite(r.a, half(r.b, 0));
    r.readWrite(r.a, half(r.b, 1));
    r.update(half(r.c, 0));
    r.update(half(r.c, 1));
    EXPECT_EQ(r.barriers(), 0u);
}

TEST(Barriers, OneForRangesThatMeetInAWord) {
    Recording r;
    r.readWrite(r.a, BufferView(r.b).sub(0, 516));
    r.readWrite(r.a, half(r.b, 1));
    EXPECT_EQ(r.barriers(), 1u);
}

TEST(Barriers, IndirectArgumentsAreARead) {
    Recording r;
    r.writeArgs(r.a);
    r.updateIndirect(r.a, r.b); // after the write of its arguments
    r.writeArgs(r.a);           // after they were read
    EXPECT_EQ(r.barriers(), 2u);
}

TEST(Barriers, TransfersCount) {
    Recording r;
    r.commands.fill(r.a, 1);
    r.readWrite(r.a, r.b);     // after the fill
    r.commands.copy(r.b, r.c); // after the kernel
    r.commands.fill(r.b, 2);   // after the copy has read
    r.commands.fill(r.a, 3);   // the kernel's read of it lies before two barriers
    EXPECT_EQ(r.barriers(), 3u);
}

TEST(Barriers, OneBarrierCoversAllBeforeIt) {
    Recording r;
    r.readWrite(r.a, r.b);
    r.readWrite(r.a, r.c);
    r.readWrite(r.b, r.a); // waits for both of the above
    r.update(r.c);
    EXPECT_EQ(r.commands.barrierCount(), 1u);
    finish(r.commands);
}

TEST(Barriers, ForgetThePastRecording) {
    Recording r;
    r.update(r.a);
    EXPECT_EQ(r.barriers(), 0u);
    ASSERT_TRUE(r.commands.begin());
    r.update(r.a);
    EXPECT_EQ(r.barriers(), 0u);
}

// The layer would see a barrier that is missing (Debian 12's does between a writer and a reader, not between two updates):
// two recorders that do not know of each other share a command buffer.
TEST(Barriers, AreMissedBySynchronizationValidation) {
    if (!synchronizationValidationIsWanted())
        GTEST_SKIP() << "without synchronization validation the layer does not look for missing barriers";
    ASSERT_TRUE(synchronizationValidationIsOn()) << "the layer is asked for, but not installed";
    expectValidationMessages(1);
    Recording r;
    Commands stranger(device(), r.commands.handle());
    r.readWrite(r.a, r.b);
    stranger.dispatch(testKernel(device(), "add_index"), kCount, AddIndexPush{kCount, 1}, {r.b, r.c});
    finish(r.commands);
}

// A kernel that writes a buffer and declares that it only reads it gets no barrier, which the layer notices.
TEST(Barriers, AreMissingAfterAKernelWhoseWriteIsNotDeclared) {
    if (!synchronizationValidationIsWanted())
        GTEST_SKIP() << "without synchronization validation the layer does not look for missing barriers";
    ASSERT_TRUE(synchronizationValidationIsOn()) << "the layer is asked for, but not installed";
    expectValidationMessages(1);
    Recording r;
    Kernel undeclared = testKernel(device(), "add_index");
    undeclared.reflection.bindings[1].readonly = true;
    undeclared.reflection.bindings[1].writeonly = false;
    r.commands.dispatch(undeclared, kCount, AddIndexPush{kCount, 1}, {r.a, r.b});
    r.readWrite(r.b, r.c);
    EXPECT_EQ(r.barriers(), 0u);
}

TEST(HazardTracker, NamesTheStagesAndWritesToWaitFor) {
    HazardTracker tracker;
    int anything = 0;
    const auto buffer = reinterpret_cast<VkBuffer>(&anything);
    const Access filled{buffer, 0, 64, true, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT};
    const Access read{buffer, 128, 192, false, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT};
    EXPECT_FALSE(tracker.add({&filled, 1}));
    EXPECT_FALSE(tracker.add({&read, 1}));
    const Access late{buffer, 32, 40, false, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT};
    const auto source = tracker.add({&late, 1});
    ASSERT_TRUE(source);
    EXPECT_EQ(source->stages, VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT);
    EXPECT_EQ(source->writes, VK_ACCESS_TRANSFER_WRITE_BIT);
    EXPECT_FALSE(tracker.add({&late, 1}));
}
