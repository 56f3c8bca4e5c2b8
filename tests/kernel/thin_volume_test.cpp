// mass_properties measures sheets and needles that have less volume than floats lose in the sum; the sum is checked in long
// double.
#include "tests/kernel/component_pools.h"

#include <cmath>
#include <random>

namespace kernel_test {
namespace {

using Vec4 = std::array<float, 4>;
using Row = std::array<long double, 3>;

struct ThinSolid {
    std::vector<Vec4> positions;
    std::vector<Word4> pieces;

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
    Row row(uint32_t k) const { return {positions[k][0], positions[k][1], positions[k][2]}; }
};

// A closed sheet of side 1, askew. `thick` is the distance of its two sides and may be less than the last digit of a float.
class Sheet : public ThinSolid {
public:
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

private:
    uint32_t at(uint32_t face, uint32_t x, uint32_t y) const { return (face * (side_ + 1) + y) * (side_ + 1) + x; }
    void addQuad(uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
        pieces.push_back({a, b, c, 0});
        pieces.push_back({a, c, d, 0});
    }

    uint32_t side_;
};

constexpr float kStep = 0x1p-23f;

// A tetrahedron with its corners along a line of length 0.2, each a few grid steps away from it.
ThinSolid needle(std::mt19937& random) {
    std::uniform_int_distribution<int> off(-3, 3);
    std::uniform_real_distribution<float> along(0, 1);
    ThinSolid solid;
    for (uint32_t k = 0; k < 4; ++k) {
        const float t = along(random);
        Vec4 p = {0.3f + 0.12f * t, -0.6f + 0.1f * t, 0.1f - 0.13f * t, 1};
        for (uint32_t axis = 0; axis < 3; ++axis)
            p[axis] = (std::round(p[axis] / kStep) + static_cast<float>(off(random))) * kStep;
        solid.positions.push_back(p);
    }
    solid.pieces = {{0, 2, 1, 0}, {0, 1, 3, 0}, {0, 3, 2, 0}, {1, 2, 3, 0}};
    return solid;
}

// The solid is component 1; the one before it has the same triangles.
float measuredVolume(const ThinSolid& solid, float unit) {
    const auto n = static_cast<uint32_t>(solid.pieces.size());
    std::vector<uint32_t> order = countUp(n);
    order.insert(order.end(), order.begin(), order.end());
    Counts counts;
    counts[COUNT_COMPONENTS] = 2;
    const auto start = bufferOf(std::vector<uint32_t>{0, n, 2 * n}), ordered = bufferOf(order);
    const auto pieces = bufferOf(solid.pieces), positions = bufferOf(solid.positions);
    const auto sources = bufferOf(std::vector<uint32_t>(n, 0)), records = blankBuffer<brittle::FragmentRecord>(2);
    onDevice([&](engine::Commands& commands) {
        commands.dispatchGroups(kernel("mass_properties"), 2, unit,
                                {counts.words, start, ordered, pieces, sources, positions, records});
    });
    const auto measured = valuesOf<brittle::FragmentRecord>(records, 2);
    EXPECT_EQ(measured[0].measure[0], measured[1].measure[0]);
    return measured[1].measure[0];
}

TEST(SmallThinVolume, IsRightForSheetsAsThinAsALastDigit) {
    for (const float thick : {1e-2f, 1e-4f, 1e-6f, 2e-7f, -1e-5f}) {
        const Sheet sheet(thick);
        const double expected = sheet.volume();
        EXPECT_NEAR(double{measuredVolume(sheet, 1)} / expected, 1, 1e-4) << thick;
        EXPECT_NEAR(double{measuredVolume(sheet, 0.25f)} / (expected / 64), 1, 1e-4) << thick;
    }
}

TEST(SmallThinVolume, OfANeedleHasItsSignAndSize) {
    std::mt19937 random(5);
    for (int k = 0; k < 50; ++k) {
        const ThinSolid solid = needle(random);
        const double expected = solid.volume();
        EXPECT_NEAR(measuredVolume(solid, 1), expected, 1e-4 * std::abs(expected)) << "needle " << k;
    }
}

// Rounding may turn a needle over. It stays thinner than a film, and so it is no cavity, for which something would have to be
// around.
TEST(SmallThinVolume, MakesNoCavityOfANeedle) {
    std::mt19937 random(6);
    std::vector<Component> needles;
    for (uint32_t k = 0; k < 200; ++k) {
        const ThinSolid solid = needle(random);
        Component component;
        for (const Word4& piece : solid.pieces) {
            reference::Triangle t;
            for (size_t corner = 0; corner < 3; ++corner)
                for (size_t axis = 0; axis < 3; ++axis)
                    t[corner][axis] = double{solid.positions[piece[corner]][axis]};
            component.triangles.push_back(t);
        }
        needles.push_back(component);
    }
    const Judged judged = judgeOnDevice(needles, kStep);
    EXPECT_EQ(judged.cavities, 0u);
    EXPECT_EQ(judged.bad, 0u);
}

} // namespace
} // namespace kernel_test
