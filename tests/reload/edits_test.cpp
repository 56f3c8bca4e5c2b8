#include "engine/reload/edits.h"

#include <gtest/gtest.h>

using engine::EditBook;

namespace {

const engine::SaveTime kNow = std::chrono::steady_clock::now();
using Kernels = std::set<engine::KernelIndex>;

} // namespace

TEST(Edits, EndWhenAllOfThemAreDecided) {
    EditBook book;
    book.change({1, 2, 3}, kNow);
    EXPECT_FALSE(book.decide(1, true));
    EXPECT_FALSE(book.decide(3, true));
    EXPECT_TRUE(book.hasUndecided());
    const auto edit = book.decide(2, true);
    ASSERT_TRUE(edit);
    EXPECT_EQ(edit->kernels, (Kernels{1, 2, 3}));
    EXPECT_TRUE(edit->refused.empty());
    EXPECT_FALSE(book.hasUndecided());
    EXPECT_FALSE(book.decide(2, true)); // of no edit
}

TEST(Edits, StayOpenWhereOneIsRefusedAndGoOnWithIt) {
    EditBook book;
    book.change({1, 2}, kNow);
    book.decide(1, true);
    const auto refused = book.decide(2, false);
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->refused, (Kernels{2}));
    book.change({2}, kNow); // mended; 1 waits for it as it is
    EXPECT_TRUE(book.isUndecided(2));
    EXPECT_FALSE(book.isUndecided(1));
    const auto mended = book.decide(2, true);
    ASSERT_TRUE(mended);
    EXPECT_EQ(mended->kernels, (Kernels{1, 2}));
    EXPECT_TRUE(mended->refused.empty());
}

TEST(Edits, ThatShareNoKernelDoNotWaitForEachOther) {
    EditBook book;
    book.change({1}, kNow);
    book.decide(1, false);
    book.change({2}, kNow);
    const auto other = book.decide(2, true);
    ASSERT_TRUE(other);
    EXPECT_EQ(other->kernels, (Kernels{2}));
}

TEST(Edits, ThatShareAKernelAreOne) {
    EditBook book;
    book.change({1, 2}, kNow);
    book.change({3}, kNow);
    book.change({2, 3}, kNow + std::chrono::seconds(1));
    EXPECT_FALSE(book.decide(2, true));
    EXPECT_FALSE(book.decide(3, true));
    const auto edit = book.decide(1, true);
    ASSERT_TRUE(edit);
    EXPECT_EQ(edit->kernels, (Kernels{1, 2, 3}));
    EXPECT_EQ(edit->saved, kNow + std::chrono::seconds(1));
}

TEST(Edits, AtTheStartLetSoundKernelsGo) {
    EditBook book;
    book.change({1, 2, 3}, kNow, true);
    book.decide(1, true);
    book.decide(2, false);
    const auto start = book.decide(3, true);
    ASSERT_TRUE(start && start->at_start);
    EXPECT_EQ(start->refused, (Kernels{2}));
    book.change({1}, kNow); // does not wait for 2
    EXPECT_EQ(book.decide(1, true)->kernels, (Kernels{1}));
    book.change({2, 3}, kNow);
    EXPECT_FALSE(book.decide(3, true));
    EXPECT_EQ(book.decide(2, true)->kernels, (Kernels{2, 3}));
}
