// Solids in one model that touch: sound, each as large as it is, whatever the last digits of floats say.
#include "modules/brittle/mesh/check.h"
#include "modules/brittle/mesh/prepare.h"
#include "modules/brittle/mesh/primitives.h"
#include "modules/brittle/mesh/repair/repair.h"
#include "tests/support/solids.h"

#include <gtest/gtest.h>

#include <random>

using namespace brittle;
using namespace support;

namespace {

ImportedMesh blockAt(const Double3& size, const Double3& at) {
    ImportedMesh block = makeCube();
    for (Double3& p : block.positions)
        for (size_t k = 0; k < 3; ++k)
            p[k] = size[k] * p[k] + at[k];
    return block;
}

// A node places a block like this: both the step and its multiple are floats.
double translation(uint32_t times, double step) {
    return static_cast<double>(static_cast<float>(times) * static_cast<float>(step));
}

// About z, then about y, in floats as a file has them.
ImportedMesh turnedBy(ImportedMesh mesh, double about_z, double about_y) {
    for (Double3& p : mesh.positions) {
        const double x = std::cos(about_z) * p[0] - std::sin(about_z) * p[1],
                     y = std::sin(about_z) * p[0] + std::cos(about_z) * p[1];
        p = {std::cos(about_y) * x + std::sin(about_y) * p[2], y, std::cos(about_y) * p[2] - std::sin(about_y) * x};
        for (double& coordinate : p)
            coordinate = static_cast<double>(static_cast<float>(coordinate));
    }
    return mesh;
}

double fractionFrom(std::mt19937& random) { return static_cast<double>(random() % 10'000) / 10'000; }

MeshReport inspect(const ImportedMesh& imported) {
    const auto model = prepareMesh(imported);
    if (!model) throw std::runtime_error(model.error().message);
    return inspectMesh(model->mesh, model->topology);
}

void expectSound(const ImportedMesh& imported, double volume, uint32_t parts) {
    const MeshReport report = inspect(imported);
    EXPECT_TRUE(report.isSound()) << report.problems.front();
    EXPECT_NEAR(report.measures.volume, volume, 1e-5 * volume);
    EXPECT_EQ(report.components, parts);
    const auto repaired = repairMesh(imported);
    ASSERT_TRUE(repaired) << repaired.error().message;
    EXPECT_EQ(repaired->notes.text(), "");
    EXPECT_EQ(repaired->model.mesh.positions, prepareMesh(imported)->mesh.positions);
}

} // namespace

TEST(TouchingParts, RowsOfBlocksAreSound) {
    std::mt19937 random(62);
    for (uint32_t row = 0; row < 24; ++row) {
        const auto count = static_cast<uint32_t>(6 + random() % 15);
        const Double3 size = {0.1 + fractionFrom(random), 0.1 + fractionFrom(random), 0.1 + fractionFrom(random)};
        const bool is_shifted = row % 3 != 0; // then no two faces have the same corners
        ImportedMesh blocks;
        for (uint32_t k = 0; k < count; ++k) {
            const double aside = is_shifted ? 0.3 * size[1] * fractionFrom(random) : 0;
            blocks = blocks + blockAt(size, {translation(k, size[0]), aside, 0.1});
        }
        expectSound(blocks, count * size[0] * size[1] * size[2], count);
    }
}

// Faces of neighbors may have some corners in common and miss others by the last digit.
TEST(TouchingParts, RowsThatAreTurnedAreSound) {
    std::mt19937 random(7);
    for (uint32_t row = 0; row < 300; ++row) {
        const auto count = static_cast<uint32_t>(6 + random() % 15);
        const Double3 size = {0.1 + fractionFrom(random), 0.1 + fractionFrom(random), 0.1 + fractionFrom(random)};
        ImportedMesh blocks;
        for (uint32_t k = 0; k < count; ++k)
            blocks = blocks + blockAt(size, {translation(k, size[0]), 0, 0});
        const ImportedMesh turned = turnedBy(blocks, 6 * fractionFrom(random), 6 * fractionFrom(random));
        const MeshReport report = inspect(turned);
        EXPECT_TRUE(report.isSound()) << row << ": " << report.problems.front();
        EXPECT_EQ(report.components, count) << row;
    }
}

TEST(TouchingParts, ABlockAmongBlocksOnAllSidesIsSound) {
    for (const double step : {1.0, 0.1, 0.7123}) {
        ImportedMesh wall;
        for (uint32_t x = 0; x < 5; ++x)
            for (uint32_t y = 0; y < 5; ++y)
                for (uint32_t z = 0; z < 5; ++z)
                    wall = wall +
                           blockAt({step, step, step}, {translation(x, step) + (y % 2) * 0.37 * step,
                                                        translation(y, step) + (z % 2) * 0.21 * step, translation(z, step)});
        expectSound(wall, 125 * step * step * step, 125);
    }
}

TEST(TouchingParts, MayReachIntoEachOtherByLessThanATouch) {
    for (const double depth : {-2e-6, -1e-7, 0.0, 1e-7, 2e-6}) {
        const ImportedMesh pair = blockAt({1, 1, 1}, {0, 0, 0}) + blockAt({1, 1, 1}, {0.2, 0.3, 1 - depth});
        expectSound(pair, 2, 2);
    }
}

TEST(TouchingParts, ASolidMayFillAHollow) {
    for (const double gap : {-1e-7, 1e-7}) {
        const double inner = 0.5 - gap;
        const ImportedMesh filled =
            makeCube() + turnedOver(blockAt({0.5, 0.5, 0.5}, {0.05, 0, 0})) + blockAt({inner, inner, inner}, {0.05, 0, 0});
        const MeshReport report = inspect(filled);
        EXPECT_TRUE(report.isSound()) << gap << ": " << report.problems.front();
        EXPECT_NEAR(report.measures.volume, 1, 1e-5);
    }
}

// The filling has every face of the hollow, so all its triangles are doubled.
TEST(TouchingParts, ASolidMayFillAHollowExactly) {
    for (const double inner : {0.4, 0.5, 1.0 / 3})
        for (const Double3& at : {Double3{0, 0, 0}, Double3{0.05, -0.02, 0.1}}) {
            const ImportedMesh filling = blockAt({inner, inner, inner}, at);
            expectSound(makeCube() + turnedOver(filling) + filling, 1, 3);
            EXPECT_EQ(inspect(makeCube() + turnedOver(filling) + filling).touching_triangles, 12u);
        }
}

TEST(TouchingParts, AHollowWithNoSolidAroundItIsADoubledSurface) {
    const MeshReport alone = inspect(makeCube() + turnedOver(makeCube()));
    ASSERT_FALSE(alone.isSound());
    EXPECT_EQ(alone.duplicate_triangles, 12u);
    const ImportedMesh ball = moved(makeIcosphere(1), 2, {9, 0, 0}); // larger, yet elsewhere
    EXPECT_GT(inspect(ball + makeCube() + turnedOver(makeCube())).misplaced_components, 0u);
}

TEST(TouchingParts, AShellMayBeThinnerThanATouch) {
    const double inner = 1 - 4e-7;
    const MeshReport report = inspect(makeIcosphere(1) + turnedOver(moved(makeIcosphere(1), inner, {0, 0, 0})));
    EXPECT_EQ(report.misplaced_components, 0u);
    EXPECT_EQ(report.cavities, 1u);
}

TEST(TouchingParts, ASolidInsideAnotherIsStillFound) {
    // Flush with one, two and three faces of the other from inside, a little too high or too low.
    for (const double off : {-1e-7, 0.0, 1e-7})
        for (uint32_t flush = 1; flush <= 3; ++flush) {
            Double3 at = {0, 0, 0};
            for (size_t k = 0; k < flush; ++k)
                at[k] = 0.25 + off;
            EXPECT_FALSE(inspect(makeCube() + blockAt({0.5, 0.5, 0.5}, at)).isSound()) << off << ", " << flush;
        }
    for (const double size : {1 - 1e-7, 1.0, 1 + 1e-7})
        EXPECT_FALSE(inspect(makeCube() + blockAt({size, size, size}, {0, 0, 0})).isSound()) << size;
}

TEST(TouchingParts, RepairSaysHowItChangesTheVolume) {
    const auto repaired = repairMesh(makeCube() + turnedOver(moved(makeCube(), 0.5, {3, 0, 0})));
    ASSERT_TRUE(repaired) << repaired.error().message;
    EXPECT_NE(repaired->notes.text().find("the volume goes from 0.875 to 1.125"), std::string::npos) << repaired->notes.text();
}
