// What the precision of signs does to cells: nothing where sites lie anyhow; where they tie, only exact signs give the
// reference diagram, and others must at least come to an end and say what did not work out.
#include "tests/hard/hard_sites.h"
#include "tests/kernel/device_cells.h"

#include <cmath>
#include <map>

namespace kernel_test {
namespace {

using brittle::Precision;

constexpr Precision kAll[] = {Precision::Exact, Precision::Double, Precision::Fast};
constexpr Path kMappings[] = {Path::Filtered, Path::FilteredEdges};

size_t wrongCells(const std::vector<reference::VoronoiCell>& expected, const DeviceCells& device) {
    size_t wrong = 0;
    for (size_t k = 0; k < expected.size(); ++k)
        if (device.cells[k].neighbors != expected[k].neighbors || device.cells[k].vertices != expected[k].vertices) ++wrong;
    return wrong + device.unfinished;
}

void expectTheSameCellsAtAnyPrecision(const reference::SiteSet& set) {
    const std::vector<reference::VoronoiCell> expected = reference::cutAllCells(set);
    for (const Precision precision : kAll)
        for (const Path path : kMappings)
            EXPECT_EQ(wrongCells(expected, cutOnDevice(set, path, precision)), 0u) << nameOf(precision);
}

TEST(Precision, DoesNotShowInCellsOfSitesThatLieAnyhow) {
    for (const uint32_t count : {65u, 1234u})
        expectTheSameCellsAtAnyPrecision(hard::snapToGrid(hard::uniformSites(count, count)).set);
}

TEST(Precision, DoesNotShowInCellsOfAnySearch) {
    const reference::SiteSet set = hard::snapToGrid(hard::uniformSites(300, 5)).set;
    const std::vector<reference::VoronoiCell> expected = reference::cutAllCells(set);
    for (const Precision precision : kAll)
        for (const Path path : {Path::FilteredLinear, Path::FilteredTree, Path::Exact})
            EXPECT_EQ(wrongCells(expected, cutOnDevice(set, path, precision)), 0u) << nameOf(precision);
}

// More faces than the kernel of a lane a cell holds.
TEST(Precision, DoesNotShowInLargeCellsOfSitesThatLieAnyhow) {
    hard::HardSites sites = hard::uniformSites(150, 7);
    for (hard::Point& p : sites.sites) {
        double size = 0;
        for (double& x : p) {
            x -= .5;
            size += x * x;
        }
        for (double& x : p) // between two spheres about the center
            x = .5 + x / std::sqrt(size) * (.3 + .001 * size);
    }
    sites.sites.push_back({.5, .5, .5});
    expectTheSameCellsAtAnyPrecision(hard::snapToGrid(sites).set);
}

struct Outcome {
    size_t right_sets = 0, wrong_cells = 0, unfinished_cells = 0;
};

Outcome outcomeOf(const std::vector<reference::VoronoiCell>& expected, const DeviceCells& device) {
    const size_t wrong = wrongCells(expected, device);
    return {wrong == 0 ? 1u : 0u, wrong, device.unfinished};
}

// Counts, for two mappings each, how many sets come out right.
std::map<Precision, Outcome> outcomesOf(std::initializer_list<size_t> chosen) {
    const std::vector<hard::HardSites> all = hard::hardSites();
    std::map<Precision, Outcome> outcomes;
    for (const size_t k : chosen) {
        const reference::SiteSet set = hard::snapToGrid(all[k]).set;
        const std::vector<reference::VoronoiCell> expected = reference::cutAllCells(set);
        for (const Precision precision : kAll)
            for (const Path path : kMappings) {
                const Outcome one = outcomeOf(expected, cutOnDevice(set, path, precision));
                Outcome& sum = outcomes[precision];
                sum.right_sets += one.right_sets;
                sum.wrong_cells += one.wrong_cells;
                sum.unfinished_cells += one.unfinished_cells;
            }
    }
    return outcomes;
}

void expectExactRight(const std::map<Precision, Outcome>& outcomes, size_t sets) {
    for (const auto& [precision, outcome] : outcomes)
        std::printf("%s: %zu of %zu right, %zu cells wrong, of these %zu not finished\n", nameOf(precision), outcome.right_sets,
                    2 * sets, outcome.wrong_cells, outcome.unfinished_cells);
    EXPECT_EQ(outcomes.at(Precision::Exact).right_sets, 2 * sets);
}

TEST(Precision, OfHardSitesThatAreFew) { expectExactRight(outcomesOf({7, 16, 24, 25}), 4); }

// A lattice, a sphere about its center, a plane, a line, a thin slab.
TEST(Precision, OfHardSites) { expectExactRight(outcomesOf({4, 5, 8, 9, 18}), 5); }

TEST(LongPrecision, OfAllHardSites) {
    expectExactRight(
        outcomesOf({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26}), 27);
}

} // namespace
} // namespace kernel_test
