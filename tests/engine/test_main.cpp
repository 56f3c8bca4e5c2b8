// main() of every test program: a test during which the validation layers said anything that it did not mean to cause has
// failed. If every test has skipped itself, the exit code is 77.
#include "engine/instance.h"
#include "tests/engine/test_device.h"
#include "tests/support/planted_kernel.h"

#include <cstdlib>
#include <gtest/gtest.h>

namespace {

uint32_t expected_messages = 0;

class ValidationGate : public testing::EmptyTestEventListener {
    void OnTestStart(const testing::TestInfo&) override {
        before_ = engine::validationMessageTotal();
        expected_messages = 0;
    }
    void OnTestEnd(const testing::TestInfo&) override {
        const uint32_t heard = engine::validationMessageTotal() - before_;
        if (heard != expected_messages) ADD_FAILURE() << heard << " messages from the validation layers";
    }
    uint32_t before_ = 0;
};

constexpr int kSkipped = 77; // as SKIP_RETURN_CODE in tests/CMakeLists.txt

// A run that checks nothing must not look like one that passed.
bool everyTestSkipped() {
    const testing::UnitTest& run = *testing::UnitTest::GetInstance();
    return run.skipped_test_count() > 0 && run.skipped_test_count() == run.test_to_run_count();
}

} // namespace

namespace engine_test {

void expectValidationMessages(uint32_t count) { expected_messages = count; }

} // namespace engine_test

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    support::plantKernel();
    testing::UnitTest::GetInstance()->listeners().Append(new ValidationGate);
    const int result = RUN_ALL_TESTS();
    const uint32_t before = engine::validationMessageTotal();
    engine_test::destroyDevices();
    if (engine::validationMessageTotal() != before) return EXIT_FAILURE;
    return result == EXIT_SUCCESS && everyTestSkipped() ? kSkipped : result;
}
