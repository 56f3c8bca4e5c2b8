// Models whose faces fold back over each other, through the program.
#include "tests/support/folder_test.h"
#include "tests/support/process.h"
#include "tests/support/solids.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <vector>

namespace {

using support::Outcome;
using support::runProgram;

class FoldedFaces : public support::FolderTest {};

// A gear, whose faces are cut into triangles from one corner.
TEST_F(FoldedFaces, AreTheReasonThatShatterGivesWhereItFails) {
    std::vector<std::array<double, 2>> outline;
    for (uint32_t k = 0; k < 80; ++k) {
        const double angle = 2 * std::numbers::pi * k / 80, radius = k % 2 == 0 ? 1 : 1.3;
        outline.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    const brittle::ImportedMesh gear = support::fanPrism(outline, 0.1);
    std::ofstream file(path("gear.obj"));
    for (const auto& [x, y, z] : gear.positions)
        file << "v " << x << ' ' << y << ' ' << z << '\n';
    for (const auto& [a, b, c] : gear.triangles)
        file << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
    file.close();
    const Outcome run = runProgram("brittle", {"shatter", path("gear.obj"), "--sites", "60", "-o", path("gear.glb")});
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_NE(run.err.find("a face of the model lies on its neighbor"), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(path("gear.glb")));
}

} // namespace
