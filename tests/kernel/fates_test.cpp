// forget_fates and check_breaking: words that other kernels read.
#include "shaders-spirv/shared/fragment_record.h"
#include "tests/kernel/lab.h"


namespace kernel_test {
namespace {

TEST(SmallFates, AreForgottenAndNothingElse) {
    Counts counts;
    for (uint32_t k = 0; k < STATUS_WORDS; ++k)
        counts[k] = 100 + k;
    onDevice([&](engine::Commands& commands) {
        commands.dispatchGroups(kernel("forget_fates"), 1, engine::NoPush{}, {counts.words});
    });
    for (uint32_t k = 0; k < STATUS_WORDS; ++k)
        EXPECT_EQ(counts[k], k == COUNT_FILMS || k == COUNT_CAVITIES ? 0 : 100 + k) << k;
}

// Three fragments of a break in which one word of its status is set.
struct Checked {
    Counts counts;
    explicit Checked(uint32_t trouble, uint32_t value = 1) {
        for (const uint32_t index : {COUNT_FRAGMENTS, COUNT_EMITTED, COUNT_COLLIDERS}) {
            counts[index] = 3;
            counts.args.mappedAs<uint32_t>()[9 * index + 6] = 3;
        }
        counts[trouble] = value;
        onDevice([&](engine::Commands& commands) {
            commands.dispatchGroups(kernel("check_breaking"), 1, engine::NoPush{}, {counts.words, counts.args});
        });
    }
    void expectFragments(uint32_t count) {
        for (const uint32_t index : {COUNT_FRAGMENTS, COUNT_EMITTED, COUNT_COLLIDERS}) {
            EXPECT_EQ(counts[index], count) << index;
            EXPECT_EQ(counts.argsOf(index)[6], count) << "groups of " << index;
        }
    }
};

TEST(SmallCheckedBreaks, KeepTheirFragmentsIfNothingFailed) {
    Checked checked(STATUS_BAD_CELLS, 0);
    checked.expectFragments(3);
    EXPECT_EQ(checked.counts[STATUS_FAILED], 0u);
}

TEST(SmallCheckedBreaks, LoseTheirFragmentsIfAnythingFailed) {
    for (const uint32_t trouble :
         {STATUS_BAD_CELLS, STATUS_BAD_CLIP, STATUS_BAD_LOOKUP, STATUS_BAD_DEPTH, STATUS_BAD_CAP, STATUS_BAD_UNION,
          STATUS_BAD_WELD, STATUS_ROUNDS_LEFT, STATUS_CROWDED, STATUS_TOO_LONG, STATUS_BAD_DIAGRAM, STATUS_OPEN_OUTLINES}) {
        SCOPED_TRACE(trouble);
        Checked checked(trouble);
        checked.expectFragments(0);
        EXPECT_EQ(checked.counts[STATUS_FAILED], FAILED_CHECK);
    }
    Checked lacking(STATUS_FAILED, FAILED_CAPACITY);
    lacking.expectFragments(0);
    EXPECT_EQ(lacking.counts[STATUS_FAILED], FAILED_CAPACITY);
}

} // namespace
} // namespace kernel_test
