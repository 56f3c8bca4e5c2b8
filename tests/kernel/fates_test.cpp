// measure_films, forget_fates and check_breaking: the volume of films against long double, and words that others read.
#include "shaders-spirv/shared/fragment_record.h"
#include "tests/kernel/lab.h"

#include <cmath>

namespace kernel_test {
namespace {

using Vec4 = std::array<float, 4>;
using Row = std::array<long double, 3>;

// A closed sheet of side 1, askew, whose two sides are so far apart; `thick` may be less than the last digit of a float.
struct Sheet {
    std::vector<Vec4> positions;
    std::vector<Word4> pieces;

    explicit Sheet(float thick, uint32_t side = 12) : side_(side) {
        for (const float height : {0.0f, thick})
            for (uint32_t y = 0; y <= side; ++y)
                for (uint32_t x = 0; x <= side; ++x) {
                    const float u = static_cast<float>(x) / static_cast<float>(side),
                                v = static_cast<float>(y) / static_cast<float>(side);
                    positions.push_back(
                        {0.8f * u + 0.1f * v, 0.7f * v - 0.3f * u, 0.4f * u + 0.5f * v + 0.1f * u * v + height, 1});
                }
        for (uint32_t y = 0; y < side; ++y)
            for (uint32_t x = 0; x < side; ++x) {
                addQuad(at(0, x, y), at(0, x, y + 1), at(0, x + 1, y + 1), at(0, x + 1, y));
                addQuad(at(1, x, y), at(1, x + 1, y), at(1, x + 1, y + 1), at(1, x, y + 1));
            }
        for (uint32_t k = 0; k < side; ++k) {
            addQuad(at(0, k, 0), at(0, k + 1, 0), at(1, k + 1, 0), at(1, k, 0));
            addQuad(at(0, k + 1, side), at(0, k, side), at(1, k, side), at(1, k + 1, side));
            addQuad(at(0, 0, k + 1), at(0, 0, k), at(1, 0, k), at(1, 0, k + 1));
            addQuad(at(0, side, k), at(0, side, k + 1), at(1, side, k + 1), at(1, side, k));
        }
    }

    double volume() const {
        long double six = 0;
        for (const Word4& p : pieces) {
            const Row a = row(p[0]), b = row(p[1]), c = row(p[2]);
            for (size_t k = 0; k < 3; ++k) {
                const size_t l = (k + 1) % 3, m = (k + 2) % 3;
                six += a[k] * (b[l] * c[m] - b[m] * c[l]);
            }
        }
        return static_cast<double>(six / 6);
    }

private:
    uint32_t at(uint32_t face, uint32_t x, uint32_t y) const { return (face * (side_ + 1) + y) * (side_ + 1) + x; }
    void addQuad(uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
        pieces.push_back({a, b, c, 0});
        pieces.push_back({a, c, d, 0});
    }
    Row row(uint32_t k) const { return {positions[k][0], positions[k][1], positions[k][2]}; }

    uint32_t side_;
};

// The sheet is component 1; the one before it, of the same triangles, is no film.
float measuredVolume(const Sheet& sheet, float unit) {
    const auto n = static_cast<uint32_t>(sheet.pieces.size());
    std::vector<uint32_t> order = countUp(n);
    order.insert(order.end(), order.begin(), order.end());
    std::vector<brittle::FragmentRecord> records(2);
    records[0].measure[0] = records[1].measure[0] = 77;
    Counts counts;
    counts[COUNT_FILMS] = 1;
    const auto films = bufferOf(std::vector<uint32_t>{1}), start = bufferOf(std::vector<uint32_t>{0, n, 2 * n});
    const auto ordered = bufferOf(order), pieces = bufferOf(sheet.pieces), positions = bufferOf(sheet.positions);
    const auto measured = bufferOf(records);
    onDevice([&](engine::Commands& commands) {
        commands.dispatchGroups(kernel("measure_films"), 3, unit,
                                {counts.words, films, start, ordered, pieces, positions, measured});
    });
    const auto after = valuesOf<brittle::FragmentRecord>(measured, 2);
    EXPECT_EQ(after[0].measure[0], 77) << "the other component stays as it is";
    return after[1].measure[0];
}

TEST(SmallFilmVolume, IsRightForSheetsAsThinAsALastDigit) {
    for (const float thick : {1e-2f, 1e-4f, 1e-6f, 2e-7f, -1e-5f}) {
        const Sheet sheet(thick);
        const double expected = sheet.volume();
        EXPECT_NEAR(double{measuredVolume(sheet, 1)} / expected, 1, 1e-4) << thick;
        EXPECT_NEAR(double{measuredVolume(sheet, 0.25f)} / (expected / 64), 1, 1e-4) << thick;
    }
}

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
