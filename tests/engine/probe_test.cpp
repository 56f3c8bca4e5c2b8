// Commands that are run one by one and shown to a probe.
#include "tests/engine/test_device.h"

#include <gtest/gtest.h>

using namespace engine;
using namespace engine_test;

namespace {

uint32_t firstWordOf(const BufferView& view) {
    Buffer target = readback(device(), 1);
    Commands commands(device());
    EXPECT_TRUE(commands.begin());
    commands.copy(view.sub(0, 4), target);
    finish(commands);
    return wordsOf(target)[0];
}

// Notes the first word of the last buffer before and after every command.
class WordProbe final : public CommandProbe {
public:
    Result<void> before(const TracedCommand& command) override {
        befores.push_back(firstWordOf(command.buffers.back()));
        return {};
    }
    Result<void> after(const TracedCommand& command) override {
        afters.push_back(firstWordOf(command.buffers.back()));
        labels.push_back(command.label);
        return refuses ? Result<void>(Error{ErrorCode::BadInput, "seen enough"}) : Result<void>();
    }
    std::vector<uint32_t> befores, afters;
    std::vector<std::string> labels;
    bool refuses = false;
};

class Probing : public testing::Test {
protected:
    void record(Commands& commands) {
        ASSERT_TRUE(commands.begin());
        commands.showTo(probe_);
        commands.fill(buffer_, 7);
        commands.beginLabel("counting");
        commands.dispatch(testKernel(device(), "increment"), 64, NoPush{}, {buffer_});
        commands.dispatch(testKernel(device(), "increment"), 64, NoPush{}, {buffer_});
        commands.endLabel();
    }
    Buffer buffer_ = upload(device(), std::vector<uint32_t>(64, 1));
    WordProbe probe_;
};

} // namespace

TEST_F(Probing, ShowsEveryCommandBeforeAndAfterItRan) {
    Commands commands(device());
    record(commands);
    finish(commands);
    EXPECT_EQ(probe_.befores, (std::vector<uint32_t>{1, 7, 8}));
    EXPECT_EQ(probe_.afters, (std::vector<uint32_t>{7, 8, 9}));
    EXPECT_EQ(probe_.labels, (std::vector<std::string>{"", "counting", "counting"}));
}

TEST_F(Probing, EndsWithTheErrorOfTheProbe) {
    probe_.refuses = true;
    Commands commands(device());
    record(commands);
    EXPECT_EQ(probe_.afters.size(), 1u);
    const auto status = commands.status();
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().message, "seen enough");
    EXPECT_FALSE(commands.submitAndWait());
}

TEST_F(Probing, IsForgottenByTheNextRecording) {
    Commands commands(device());
    record(commands);
    finish(commands);
    ASSERT_TRUE(commands.begin());
    commands.fill(buffer_, 3);
    finish(commands);
    EXPECT_EQ(probe_.afters.size(), 3u);
    EXPECT_EQ(firstWordOf(buffer_), 3u);
}
