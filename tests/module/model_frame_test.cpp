// Units and axes of FBX and COLLADA: the same model arrives in meters with y up, whatever the file counts in.
#include "modules/brittle/mesh/check.h"
#include "modules/brittle/mesh/import.h"
#include "modules/brittle/mesh/model_frame.h"
#include "modules/brittle/mesh/prepare.h"
#include "tests/support/model_texts.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace brittle;
using namespace support;

namespace {

struct Arrived {
    Double3 low = {0, 0, 0}, high = {0, 0, 0};
    double volume = 0;
    std::vector<std::string> notes;
};

Arrived arrived(const std::string& bytes, const char* ending) {
    Arrived result;
    const auto imported = importMesh(bytes, ending);
    EXPECT_TRUE(imported) << (imported ? "" : imported.error().message);
    if (!imported) return result;
    result.low = result.high = imported->positions.at(0);
    for (const Double3& p : imported->positions)
        for (size_t axis = 0; axis < 3; ++axis) {
            result.low[axis] = std::min(result.low[axis], p[axis]);
            result.high[axis] = std::max(result.high[axis], p[axis]);
        }
    const auto model = prepareMesh(*imported);
    EXPECT_FALSE(model->notes.turned_inside_out);
    result.volume = checkMesh(model->mesh, model->topology)->measures.volume;
    result.notes = imported->notes;
    return result;
}

void expectBox(const Arrived& box, const Double3& low, const Double3& high) {
    for (size_t axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(box.low[axis], low[axis], 1e-6) << axis;
        EXPECT_NEAR(box.high[axis], high[axis], 1e-6) << axis;
    }
    const Double3 size = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
    EXPECT_NEAR(box.volume, size[0] * size[1] * size[2], 1e-5);
}

const FileAxis kX = {0, 1}, kY = {1, 1}, kZ = {2, 1}, kMinusY = {1, -1}, kMinusZ = {2, -1};

} // namespace

TEST(FbxUnits, CentimetersInchesMillimetersAndMeters) {
    struct Unit {
        double centimeters;
        const char* note;
    };
    for (const auto& [centimeters, note] :
         {Unit{1, "unit: 1 cm; scaled by 0.01 to meters"}, Unit{0.1, "unit: 0.1 cm; scaled by 0.001 to meters"},
          Unit{2.54, "unit: 2.54 cm; scaled by 0.0254 to meters"}, Unit{100, ""}}) {
        const double unit = centimeters / 100;
        const Arrived box = arrived(fbx(settingsBlock({.unit = centimeters}), {1 / unit, 2 / unit, 3 / unit}), ".fbx");
        expectBox(box, {0, 0, 0}, {1, 2, 3});
        EXPECT_EQ(box.notes, *note ? std::vector<std::string>{note} : std::vector<std::string>{});
    }
}

// Blender counts in meters, and by its setting scales the node by 100, or the unit, or the corners.
TEST(FbxUnits, BlenderScalesInThreeWays) {
    expectBox(arrived(fbx(settingsBlock({.unit = 1}), {1, 2, 3}, 100), ".fbx"), {0, 0, 0}, {1, 2, 3});
    expectBox(arrived(fbx(settingsBlock({.unit = 100}), {1, 2, 3}), ".fbx"), {0, 0, 0}, {1, 2, 3});
    expectBox(arrived(fbx(settingsBlock({.unit = 1}), {100, 200, 300}), ".fbx"), {0, 0, 0}, {1, 2, 3});
}

TEST(FbxUnits, WithoutSettingsAreCentimeters) { expectBox(arrived(fbx("", {100, 200, 300}), ".fbx"), {0, 0, 0}, {1, 2, 3}); }

TEST(FbxAxes, ZUpIsTurned) {
    const FbxSettings max_settings = {.unit = 100, .right = kX, .up = kZ, .front = kMinusY};
    const Arrived box = arrived(fbx(settingsBlock(max_settings), {1, 2, 3}), ".fbx");
    expectBox(box, {0, 0, -2}, {1, 3, 0});
    EXPECT_EQ(box.notes, std::vector<std::string>{"z up: turned so that y is up"});
}

TEST(FbxAxes, XUpAndFrontAside) {
    expectBox(arrived(fbx(settingsBlock({.unit = 100, .right = kMinusY, .up = kX, .front = kZ}), {1, 2, 3}), ".fbx"),
              {-2, 0, 0}, {0, 1, 3});
    const Arrived box = arrived(fbx(settingsBlock({.unit = 100, .right = kMinusZ, .up = kY, .front = kX}), {1, 2, 3}), ".fbx");
    expectBox(box, {-3, 0, 0}, {0, 2, 1});
    EXPECT_EQ(box.notes, std::vector<std::string>{"front at x: turned so that it is at z"});
}

TEST(FbxAxes, LeftHandedOnesAreMirrored) {
    const Arrived box = arrived(fbx(settingsBlock({.unit = 100, .front = kMinusZ}), {1, 2, 3}), ".fbx");
    expectBox(box, {0, 0, -3}, {1, 2, 0});
    EXPECT_EQ(box.notes.back(), "left-handed axes: mirrored, so that they are right-handed");
}

TEST(FbxAxes, ImpossibleOnesAreReported) {
    for (const FbxSettings& settings : {FbxSettings{.up = kX}, {.up = {7, 1}}, {.up = {-1, 1}}, {.up = {1, 0}}}) {
        const Arrived box = arrived(fbx(settingsBlock(settings), {100, 200, 300}), ".fbx");
        expectBox(box, {0, 0, 0}, {1, 2, 3});
        EXPECT_EQ(box.notes,
                  (std::vector<std::string>{"UpAxis, FrontAxis and CoordAxis are no three axes with their signs; taken as y up",
                                            "unit: 1 cm; scaled by 0.01 to meters"}));
    }
}

// The unit says nothing of the axes, and they say nothing of it.
TEST(FbxUnits, ImpossibleOnesAreReportedAndTheAxesKept) {
    const Arrived box = arrived(fbx(settingsBlock({.unit = -2, .up = kZ, .front = kMinusY}), {100, 200, 300}), ".fbx");
    expectBox(box, {0, 0, -2}, {1, 3, 0});
    EXPECT_EQ(box.notes.front(), "UnitScaleFactor is -2, must be above 0; taken as 1 cm");
    const Arrived turned_over = arrived(fbx(settingsBlock({.unit = 2, .up = kX}), {50, 100, 150}), ".fbx");
    expectBox(turned_over, {0, 0, 0}, {1, 2, 3});
}

TEST(FbxUnits, ZeroIsRefusedByName) {
    const auto refused = importMesh(fbx(settingsBlock({.unit = 0}), {1, 2, 3}), ".fbx");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message, "cannot be read: FBX: The UnitScaleFactor must be non-zero; export it again");
}

TEST(ColladaUnits, AreConvertedOnceAndReported) {
    const Arrived plain = arrived(collada("<up_axis>Y_UP</up_axis>", {1, 2, 3}), ".dae");
    expectBox(plain, {0, 0, 0}, {1, 2, 3});
    EXPECT_TRUE(plain.notes.empty());
    const Arrived inches = arrived(
        collada("<unit meter=\"0.0254\" name=\"inch\"/><up_axis>Z_UP</up_axis>", {1 / .0254, 2 / .0254, 3 / .0254}), ".dae");
    expectBox(inches, {0, 0, -2}, {1, 3, 0});
    EXPECT_EQ(inches.notes,
              (std::vector<std::string>{"unit: 2.54 cm; scaled by 0.0254 to meters", "z up: turned so that y is up"}));
    expectBox(arrived(collada("<up_axis>X_UP</up_axis>", {1, 2, 3}), ".dae"), {-2, 0, 0}, {0, 1, 3});
}

TEST(ColladaUnits, ImpossibleOnesAreMetersAndTheAxisIsKept) {
    for (const char* unit : {"0", "-1", "abc", "nan", "1e999"}) {
        const Arrived box = arrived(
            collada("<unit name=\"x\" meter=\"" + std::string(unit) + "\"/><up_axis>Z_UP</up_axis>", {1, 2, 3}), ".dae");
        expectBox(box, {0, 0, -2}, {1, 3, 0});
        EXPECT_EQ(box.notes, (std::vector<std::string>{"z up: turned so that y is up",
                                                       "unit meter is \"" + std::string(unit) +
                                                           "\", must be a number above 0; taken as 1 meter"}));
    }
}

TEST(ColladaUnits, MayHaveADecimalComma) {
    expectBox(arrived(collada("<unit meter='0,5'/>", {2, 4, 6}), ".dae"), {0, 0, 0}, {1, 2, 3});
}

TEST(ColladaUnits, AnUnknownAxisIsReported) {
    const Arrived box = arrived(collada("<up_axis>W_UP</up_axis>", {1, 2, 3}), ".dae");
    expectBox(box, {0, 0, 0}, {1, 2, 3});
    EXPECT_EQ(box.notes, std::vector<std::string>{"up_axis is \"W_UP\", must be X_UP, Y_UP or Z_UP; taken as Y_UP"});
}

TEST(ModelFrame, IsFoundInItsTransform) {
    const ModelFrame inches{0.0254, {2, 1}, {0, -1}, {1, 1}};
    ModelFrame found;
    ASSERT_TRUE(findFrame(toMeters(inches), found));
    EXPECT_EQ(found.meters_per_unit, 0.0254);
    EXPECT_EQ(found.up, inches.up);
    Transform uneven = toMeters(inches);
    uneven.rows[1][0] *= 2;
    EXPECT_FALSE(findFrame(uneven, found));
    Transform moved = toMeters(inches);
    moved.offset = {1, 0, 0};
    EXPECT_FALSE(findFrame(moved, found));
}
