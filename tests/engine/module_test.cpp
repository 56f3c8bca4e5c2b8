#include "engine/frame.h"
#include "tests/engine/test_device.h"

#include <gtest/gtest.h>

using namespace engine;
using namespace engine_test;

namespace {

// Writes what happens to it into a log, and counts frames on the device.
class Counter : public Module {
public:
    Counter(std::string name, std::vector<std::string>& log, bool fails = false)
        : name_(std::move(name)), log_(log), fails_(fails) {}
    ModuleInfo info() const override { return {name_, "1.0"}; }
    Result<void> onDevice(Device& device) override {
        log_.push_back(name_ + " starts");
        if (fails_) return Error{ErrorCode::Capacity, "no room"};
        words = upload(device, {0});
        return {};
    }
    Result<void> onFrame(FrameContext& frame) override {
        frame.commands.beginLabel(name_);
        frame.commands.dispatch(testKernel(frame.device, "increment"), 1, NoPush{}, {words});
        frame.commands.endLabel();
        last_time = frame.time;
        return {};
    }
    void onShutdown() override {
        log_.push_back(name_ + " ends");
        words = {};
    }
    Buffer words;
    double last_time = -1;

private:
    std::string name_;
    std::vector<std::string>& log_;
    bool fails_;
};

} // namespace

TEST(Modules, StartInOrderAndEndInReverse) {
    std::vector<std::string> log;
    {
        ModuleRegistry registry;
        ASSERT_TRUE(registry.add(std::make_unique<Counter>("one", log)));
        ASSERT_TRUE(registry.add(std::make_unique<Counter>("two", log)));
        const auto twice = registry.add(std::make_unique<Counter>("one", log));
        ASSERT_FALSE(twice);
        EXPECT_NE(twice.error().message.find("one"), std::string::npos);
        ASSERT_TRUE(registry.start(device()));
        EXPECT_FALSE(registry.add(std::make_unique<Counter>("late", log)));
        EXPECT_EQ(registry.find("two"), registry.modules()[1].get());
        EXPECT_EQ(registry.find("late"), nullptr);
    }
    EXPECT_EQ(log, (std::vector<std::string>{"one starts", "two starts", "two ends", "one ends"}));
}

TEST(Modules, AFailedStartIsUndone) {
    std::vector<std::string> log;
    ModuleRegistry registry;
    ASSERT_TRUE(registry.add(std::make_unique<Counter>("one", log)));
    ASSERT_TRUE(registry.add(std::make_unique<Counter>("bad", log, true)));
    const auto started = registry.start(device());
    ASSERT_FALSE(started);
    EXPECT_EQ(started.error().code, ErrorCode::Capacity);
    EXPECT_NE(started.error().message.find("bad"), std::string::npos);
    EXPECT_EQ(log, (std::vector<std::string>{"one starts", "bad starts", "one ends"}));
}

TEST(Frames, RunEveryModuleOnce) {
    std::vector<std::string> log;
    ModuleRegistry registry;
    ASSERT_TRUE(registry.add(std::make_unique<Counter>("one", log)));
    ASSERT_TRUE(registry.add(std::make_unique<Counter>("two", log)));
    ASSERT_TRUE(registry.start(device()));
    FrameLoop loop(device(), registry, 0.25);
    for (uint32_t i = 0; i < 3; ++i) {
        const auto report = loop.step();
        ASSERT_TRUE(report) << report.error().message;
        EXPECT_EQ(report->index, i);
        EXPECT_DOUBLE_EQ(report->time, 0.25 * (i + 1));
        ASSERT_EQ(report->timings.size(), 2u);
        EXPECT_EQ(report->timings[1].name, "two");
    }
    for (const auto& module : registry.modules()) {
        const auto& counter = static_cast<const Counter&>(*module);
        EXPECT_EQ(wordsOf(counter.words)[0], 3u);
        EXPECT_DOUBLE_EQ(counter.last_time, 0.5);
    }
}
