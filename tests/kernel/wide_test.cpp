// The fixed-width integers of the kernels against plain big integers.
#include "tests/kernel/lab.h"
#include "tests/reference/big_int.h"

#include <random>

namespace kernel_test {
namespace {

using reference::BigInt;

struct Wide128 {
    uint64_t words[2];
};
struct Wide192 {
    uint64_t words[3];
};
BigInt valueOf(const Wide128& w) { return BigInt::fromWords(w.words, 2); }
BigInt valueOf(const Wide192& w) { return BigInt::fromWords(w.words, 3); }

struct Operands {
    int64_t a, b;
    Wide128 x, y;
    int64_t factor, pad;
};

struct Results {
    Wide128 product, unsigned_product, scaled, sum, difference, negated, doubled, shifted, minor;
    Wide192 long_product, long_sum;
    int64_t signs;
};

// Whole words, few bits and the borders in between come up about as often.
class Draw {
public:
    int64_t upTo(int bits) {
        const int width = static_cast<int>(random_() % static_cast<unsigned>(bits + 1));
        if (width == 0) return 0;
        int64_t value = static_cast<int64_t>(random_() >> (64 - width));
        if (random_() % 4 == 0) value = (int64_t{1} << (width - 1)) - static_cast<int64_t>(random_() % 3 == 0);
        return random_() % 2 == 0 ? value : -value;
    }
    Wide128 wide() {
        const int64_t high = upTo(31);
        const uint64_t low = random_() % 3 == 0 ? (random_() % 2 == 0 ? 0 : ~uint64_t{0}) : random_();
        return {{low, static_cast<uint64_t>(high)}};
    }

private:
    std::mt19937_64 random_{7};
};

std::vector<Operands> drawOperands(size_t count) {
    Draw draw;
    std::vector<Operands> operands(count);
    for (Operands& o : operands)
        o = {draw.upTo(53), draw.upTo(53), draw.wide(), draw.wide(), draw.upTo(30), 0};
    operands[0].y = operands[0].x;
    return operands;
}

void expectExact(const Operands& o, const Results& r) {
    const BigInt a(o.a), b(o.b), x = valueOf(o.x), y = valueOf(o.y), factor(o.factor);
    const uint64_t unsigned_words[2][2] = {{o.x.words[0], 0}, {o.y.words[0], 0}};
    const BigInt low_product = BigInt::fromWords(unsigned_words[0], 2) * BigInt::fromWords(unsigned_words[1], 2);
    EXPECT_EQ(valueOf(r.product), a * b);
    EXPECT_EQ(r.unsigned_product.words[0], low_product.word(0));
    EXPECT_EQ(r.unsigned_product.words[1], low_product.word(1));
    EXPECT_EQ(valueOf(r.scaled), x * factor);
    EXPECT_EQ(valueOf(r.sum), x + y);
    EXPECT_EQ(valueOf(r.difference), x - y);
    EXPECT_EQ(valueOf(r.negated), -x);
    EXPECT_EQ(valueOf(r.doubled), x + x);
    EXPECT_EQ(valueOf(r.shifted), x * BigInt(1 << 25));
    EXPECT_EQ(valueOf(r.minor), a * factor - b * b);
    EXPECT_EQ(valueOf(r.long_product), x * y);
    EXPECT_EQ(valueOf(r.long_sum), x * y + y * a);
    EXPECT_EQ(r.signs, x.sign() + 10 * (x * y).sign() + (x < y ? 100 : 0));
}

TEST(Wide, OperationsAreExact) {
    const std::vector<Operands> operands = drawOperands(20'000);
    const uint32_t n = static_cast<uint32_t>(operands.size());
    const engine::Buffer in = bufferOf(operands), out = blankBuffer<Results>(n);
    onDevice([&](engine::Commands& commands) { commands.dispatch(testKernel("wide_ops"), n, n, {in, out}); });
    const std::vector<Results> results = valuesOf<Results>(out, n);
    for (uint32_t k = 0; k < n && !HasFailure(); ++k) {
        SCOPED_TRACE(k);
        expectExact(operands[k], results[k]);
    }
}

} // namespace
} // namespace kernel_test
