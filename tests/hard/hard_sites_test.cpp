#include "tests/hard/hard_sites.h"

#include <gtest/gtest.h>

#include <set>

namespace hard {
namespace {

TEST(HardSites, CorpusHasItsSetsAndSizes) {
    const std::vector<HardSites> all = hardSites();
    ASSERT_EQ(all.size(), 27u);
    const std::vector<size_t> sizes = {4096, 2197, 2916, 1458, 729,  1001, 1000, 100,  1000, 1000, 1100, 1100, 1100, 1100,
                                       1100, 1000, 8,    1000, 1000, 1000, 1000, 1000, 1000, 800,  1,    2,    301};
    std::set<std::string> names;
    for (size_t k = 0; k < all.size(); ++k) {
        EXPECT_EQ(all[k].sites.size(), sizes[k]) << all[k].name;
        names.insert(all[k].name);
    }
    EXPECT_EQ(names.size(), all.size());
}

TEST(HardSites, LieInTheirBoxes) {
    for (const HardSites& hard : hardSites())
        for (const Point& p : hard.sites)
            for (size_t k = 0; k < 3; ++k) {
                ASSERT_GE(p[k], hard.lower[k]) << hard.name;
                ASSERT_LE(p[k], hard.upper[k]) << hard.name;
            }
}

TEST(HardSites, SnappingWeldsWhatFallsTogether) {
    const std::vector<HardSites> all = hardSites();
    const GridSites doubles = snapToGrid(all[10]), one_bit_apart = snapToGrid(all[25]);
    EXPECT_EQ(doubles.set.sites.size(), 1000u);
    EXPECT_EQ(doubles.welded, 100u);
    EXPECT_EQ(one_bit_apart.set.sites.size(), 1u);
    for (const HardSites& hard : all) {
        const GridSites grid = snapToGrid(hard);
        EXPECT_EQ(grid.set.sites.size() + grid.welded, hard.sites.size());
        EXPECT_LT(grid.set.box.upper[0], 1 << 24);
    }
}

TEST(HardSites, GeneratorsGiveTheSizesAskedFor) {
    EXPECT_EQ(sphereAroundCenter(2000, .3).sites.size(), 2001u);
    EXPECT_EQ(cubicLattice(5).sites.size(), 125u);
    EXPECT_EQ(clusters(4, 25, 1e-3, 1).sites.size(), 100u);
    EXPECT_EQ(uniformSites(77, 1).sites.size(), 77u);
}

} // namespace
} // namespace hard
