// Units and axes of FBX and COLLADA: the same model arrives in meters with y up, whatever the file counts in.
#include "modules/brittle/mesh/check.h"
#include "modules/brittle/mesh/import.h"
#include "modules/brittle/mesh/model_frame.h"
#include "modules/brittle/mesh/prepare.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace brittle;

namespace {

// A box of that size in units of the file, its lower corner at the origin.
std::string boxCorners(const Double3& size) {
    std::string text;
    for (int k = 0; k < 8; ++k)
        for (int axis = 0; axis < 3; ++axis)
            text += (text.empty() ? "" : ",") + std::to_string(k >> axis & 1 ? size[static_cast<size_t>(axis)] : 0.0);
    return text;
}

struct FbxSettings {
    double unit = 1; // centimeters
    FileAxis right = {0, 1}, up = {1, 1}, front = {2, 1};
};

std::string axisLines(const std::string& name, const FileAxis& axis) {
    return "P: \"" + name + "\", \"int\", \"Integer\", \"\"," + std::to_string(axis.index) + "\nP: \"" + name +
           "Sign\", \"int\", \"Integer\", \"\"," + std::to_string(axis.sign) + "\n";
}

std::string settingsBlock(const FbxSettings& settings) {
    return "GlobalSettings: {\nVersion: 1000\nProperties70: {\n" + axisLines("UpAxis", settings.up) +
           axisLines("FrontAxis", settings.front) + axisLines("CoordAxis", settings.right) +
           "P: \"UnitScaleFactor\", \"double\", \"Number\", \"\"," + std::to_string(settings.unit) + "\n}\n}\n";
}

// FBX as text, with one node of that scale.
std::string fbx(const std::string& settings, const Double3& size, double node_scale = 1) {
    const std::string scale = std::to_string(node_scale);
    return "; FBX 7.4.0 project file\nFBXHeaderExtension: {\nFBXHeaderVersion: 1003\nFBXVersion: 7400\n}\n" + settings +
           "Definitions: {\nVersion: 100\nCount: 2\nObjectType: \"Geometry\" {\nCount: 1\n}\nObjectType: \"Model\" {\nCount: "
           "1\n}"
           "\n}\nObjects: {\nGeometry: 100, \"Geometry::box\", \"Mesh\" {\nVertices: *24 {\na: " +
           boxCorners(size) +
           "\n}\nPolygonVertexIndex: *24 {\na: 0,2,3,-2,4,5,7,-7,0,1,5,-5,2,6,7,-4,0,4,6,-3,1,3,7,-6\n}\nGeometryVersion: "
           "124\n}\n"
           "Model: 200, \"Model::box\", \"Mesh\" {\nVersion: 232\nProperties70: {\nP: \"Lcl Scaling\", \"Lcl Scaling\", \"\", "
           "\"A\"," +
           scale + "," + scale + "," + scale +
           "\n}\nShading: T\nCulling: \"CullingOff\"\n}\n}\nConnections: {\nC: \"OO\",200,0\nC: \"OO\",100,200\n}\n";
}

std::string collada(const std::string& asset, const Double3& size) {
    std::string corners = boxCorners(size);
    std::replace(corners.begin(), corners.end(), ',', ' ');
    return "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\"><asset>" +
           asset + "</asset><library_geometries><geometry id=\"g\"><mesh><source id=\"p\"><float_array id=\"a\" count=\"24\">" +
           corners +
           "</float_array><technique_common><accessor source=\"#a\" count=\"8\" stride=\"3\"><param name=\"X\" type=\"float\"/>"
           "<param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor></technique_common></source>"
           "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices><polylist count=\"6\"><input "
           "semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><vcount>4 4 4 4 4 4</vcount><p>0 2 3 1 4 5 7 6 0 1 5 4 2 6 7 3 0 4 "
           "6 2 "
           "1 3 7 5</p></polylist></mesh></geometry></library_geometries><library_visual_scenes><visual_scene id=\"s\"><node "
           "id=\"n\"><instance_geometry "
           "url=\"#g\"/></node></visual_scene></library_visual_scenes><scene><instance_visual_scene "
           "url=\"#s\"/></scene></COLLADA>";
}

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

TEST(FbxAxes, ImpossibleSettingsAreReported) {
    for (const FbxSettings& settings : {FbxSettings{.up = kX}, {.up = {7, 1}}, {.up = {-1, 1}}, {.up = {1, 0}}, {.unit = -1}}) {
        const Arrived box = arrived(fbx(settingsBlock(settings), {100, 200, 300}), ".fbx");
        expectBox(box, {0, 0, 0}, {1, 2, 3});
        EXPECT_EQ(box.notes.size(), 2u);
        EXPECT_EQ(box.notes.front().substr(0, 12), "unit or axes");
    }
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

// An exporter for Blender, of which models for Godot come, writes colors so.
TEST(Collada, BlanksBeforeNumbersAreSkipped) {
    const std::string effects =
        "<library_effects><effect id=\"e\"><profile_COMMON><technique sid=\"t\"><blinn><emission><color>  0.0 "
        "0.0 0.0 1.0  </color></emission></blinn></technique></profile_COMMON></effect></library_effects>";
    std::string text = collada("<up_axis>Y_UP</up_axis>", {1, 2, 3});
    text.insert(text.find("<library_geometries>"), effects);
    expectBox(arrived(text, ".dae"), {0, 0, 0}, {1, 2, 3});
}

TEST(Collada, PartsThatReferToNothingAreNoted) {
    std::string text = collada("<up_axis>Y_UP</up_axis>", {1, 2, 3});
    const std::string instance = "<instance_geometry url=\"#g\"/>";
    ASSERT_NE(text.find(instance), text.npos);
    text.insert(text.find(instance), "<instance_geometry url=\"#missing\"/>");
    const auto mesh = importMesh(text, ".dae");
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_TRUE(std::ranges::any_of(mesh->notes, [](const std::string& note) { return note.find("missing") != note.npos; }));
}

TEST(Collada, Utf16IsRefusedByName) {
    std::string wide = "\xFF\xFE";
    for (const char c : collada("", {1, 2, 3}))
        wide += std::string{c, '\0'};
    const auto refused = importMesh(wide, ".dae");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message, "saved as UTF-16; save it as ASCII or UTF-8");
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
