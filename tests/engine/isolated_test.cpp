// Code that cannot be trusted, run in a process of its own.
#include "engine/isolated.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>
#include <unistd.h>

using namespace engine;
using End = IsolatedRun::End;

namespace {

std::string goOnForEver() {
    for (;;)
        std::this_thread::yield();
}

End endOf(const std::function<std::string()>& work, const IsolationLimits& limits = {}) {
    return runIsolated(work, limits).end;
}

TEST(Isolation, HandsOverWhatComesOut) {
    EXPECT_EQ(runIsolated([] { return std::string("a\0b", 3); }).answer, std::string("a\0b", 3));
    const std::string large = std::string(1000, 'x') + std::string(900'000, 'y');
    const IsolatedRun run = runIsolated([&] { return large; });
    EXPECT_TRUE(run.isDone());
    EXPECT_EQ(run.answer, large);
}

TEST(Isolation, SurvivesWhateverTheWorkDoes) {
    EXPECT_EQ(endOf([]() -> std::string { std::abort(); }), End::Died);
    EXPECT_EQ(endOf([]() -> std::string { throw 1; }), End::Died);
    EXPECT_EQ(endOf([]() -> std::string { _exit(0); }), End::Died);
    EXPECT_EQ(endOf([]() -> std::string { throw std::bad_alloc(); }), End::OutOfMemory);
    EXPECT_EQ(endOf(goOnForEver, {.seconds = 1}), End::OutOfTime);
}

TEST(Isolation, EndsWhatNobodyWantsAnyMore) {
    std::atomic<bool> is_unwanted = false;
    std::thread other([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        is_unwanted = true;
    });
    EXPECT_EQ(runIsolated(goOnForEver, {}, [&] { return is_unwanted.load(); }).end, End::Unwanted);
    other.join();
    EXPECT_TRUE(runIsolated([] { return std::string(); }, {}, [] { return false; }).isDone());
}

// As a child does whose allocator was forked while another thread held its lock.
TEST(Isolation, ForksAnewWhatWaitsForALockThatNobodyHolds) {
    std::mutex mutex;
    mutex.lock();
    std::thread other([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(500));
        mutex.unlock();
    });
    const IsolatedRun run = runIsolated([&] {
        const std::lock_guard lock(mutex);
        return std::string("free");
    });
    other.join();
    EXPECT_EQ(run.answer, "free");
}

TEST(Isolation, WaitsForWhatSleepsIfItAlwaysDoes) {
    const IsolatedRun run = runIsolated([] {
        std::this_thread::sleep_for(std::chrono::milliseconds(2100));
        return std::string("awake");
    });
    EXPECT_EQ(run.answer, "awake");
}

TEST(Isolation, LimitsMemory) {
    if (!isolationLimitsMemory()) GTEST_SKIP() << "the address sanitizer reserves terabytes of addresses";
    const auto touch = [](size_t megabytes) { return [=] { return std::string(megabytes << 20, 'x').substr(0, 1); }; };
    EXPECT_EQ(endOf(touch(1024), {.bytes = 100 << 20}), End::OutOfMemory);
    EXPECT_EQ(endOf(touch(50), {.bytes = 200 << 20}), End::Done);
}

} // namespace
