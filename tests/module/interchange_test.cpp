// FBX and COLLADA files with parts that assimp drops or misreads: each is noted by name, or refused with the line.
#include "modules/brittle/mesh/import.h"
#include "modules/brittle/mesh/interchange/fbx_objects.h"
#include "modules/brittle/mesh/vector_math.h"
#include "tests/support/model_texts.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace brittle;
using namespace support;

namespace {

using Notes = std::vector<std::string>;

constexpr Double3 kSize = {1, 2, 3};

std::string refusalOf(const std::string& bytes, const char* ending) {
    const auto mesh = importMesh(bytes, ending);
    return mesh ? "" : mesh.error().message;
}

// Without the words of assimp.
Notes notesOf(const std::string& bytes, const char* ending) {
    auto mesh = importMesh(bytes, ending);
    EXPECT_TRUE(mesh) << mesh.error().message;
    if (!mesh) return {};
    std::erase_if(mesh->notes, [](const std::string& note) { return note.starts_with("the reader warns: "); });
    return mesh->notes;
}

double volumeOf(const std::string& bytes, const char* ending) {
    const auto mesh = importMesh(bytes, ending);
    EXPECT_TRUE(mesh) << mesh.error().message;
    double volume = 0;
    for (const Index3& t : mesh ? mesh->triangles : std::vector<Index3>())
        volume += dot(mesh->positions[t[0]], cross(mesh->positions[t[1]], mesh->positions[t[2]])) / 6;
    return volume;
}

// ---- FBX --------------------------------------------------------------------------------------------------------------------

const std::string kMeters = settingsBlock({.unit = 100});

std::string geometry(int id, const std::string& name, const std::string& kind = "Mesh") {
    return "Geometry: " + std::to_string(id) + ", \"Geometry::" + name + "\", \"" + kind +
           "\" {\nVertices: *12 {\na: 5,0,0,6,0,0,5,1,0,5,0,1\n}\nPolygonVertexIndex: *12 {\na: "
           "0,2,-2,0,1,-4,1,2,-4,0,3,-3\n}\nGeometryVersion: 124\n}\n";
}

std::string model(int id) {
    return "Model: " + std::to_string(id) +
           ", \"Model::m\", \"Mesh\" {\nVersion: 232\nShading: T\nCulling: \"CullingOff\"\n}\n";
}

// The box with more objects and connections.
std::string fbxWith(const std::string& objects, const std::string& connections) {
    const std::string box = fbx(kMeters, kSize);
    return withReplaced(withReplaced(box, "Model: 200,", objects + "Model: 200,"), "C: \"OO\",200,0\n",
                        "C: \"OO\",200,0\n" + connections);
}

TEST(FbxObjects, ThatAreConnectedAreReadWithoutANote) {
    const std::string file = fbxWith(geometry(101, "extra") + model(201), "C: \"OO\",101,201\nC: \"OO\",201,200\n");
    EXPECT_NEAR(volumeOf(file, ".fbx"), 6 + 1.0 / 6, 1e-6);
    EXPECT_EQ(notesOf(file, ".fbx"), Notes{});
}

TEST(FbxObjects, ThatAreConnectedToNothingAreNamed) {
    const std::string note = "1 mesh that no connection leads to the scene is left out: \"extra\"";
    const std::string file = fbxWith(geometry(101, "extra"), "");
    EXPECT_NEAR(volumeOf(file, ".fbx"), 6, 1e-6);
    EXPECT_EQ(notesOf(file, ".fbx"), Notes{note});
    // Its model is connected to nothing, to itself in a circle, or to the scene by a property.
    const std::string joined = "C: \"OO\",101,201\n";
    EXPECT_EQ(notesOf(fbxWith(geometry(101, "extra") + model(201), joined), ".fbx"), Notes{note});
    const std::string circle = joined + "C: \"OO\",201,202\nC: \"OO\",202,201\n";
    EXPECT_EQ(notesOf(fbxWith(geometry(101, "extra") + model(201) + model(202), circle), ".fbx"), Notes{note});
    EXPECT_EQ(notesOf(fbxWith(geometry(101, "extra"), "C: \"OO\",101,0\n"), ".fbx"), Notes{note});
}

TEST(FbxObjects, ManyAreCounted) {
    std::string objects;
    for (const int id : {101, 102, 103, 104})
        objects += geometry(id, id == 102 ? "" : "part " + std::to_string(id));
    EXPECT_EQ(notesOf(fbxWith(objects, ""), ".fbx"),
              Notes{"4 meshes that no connection leads to the scene are left out: \"part 101\", 102, \"part 103\", ..."});
}

TEST(FbxObjects, ThatAreNoMeshesAreNamed) {
    EXPECT_EQ(notesOf(fbxWith(geometry(101, "sail", "NurbsSurface"), "C: \"OO\",101,200\n"), ".fbx"),
              Notes{"1 geometry that is no mesh is left out: \"sail\" (NurbsSurface)"});
    EXPECT_EQ(notesOf(fbxWith(geometry(101, "smile", "Shape"), ""), ".fbx"), Notes{}); // a target of a morph
}

TEST(FbxObjects, RefusalsOfEmptyScenesNameThem) {
    EXPECT_EQ(
        refusalOf(withReplaced(fbx(kMeters, kSize), "C: \"OO\",200,0\n", ""), ".fbx"),
        "no triangles in it (1 mesh that no connection leads to the scene is left out: \"box\"); export the model with its "
        "meshes");
}

TEST(FbxObjects, RefusalsNameTheErrorOfTheirOnlyMesh) {
    const std::string refusal = refusalOf(withReplaced(fbx(kMeters, kSize), ",3,7,-6", ",3,7,-66"), ".fbx");
    EXPECT_NE(refusal.find("polygon vertex index out of range"), refusal.npos) << refusal;
    EXPECT_TRUE(refusal.ends_with("); export the model with its meshes")) << refusal;
}

TEST(FbxObjects, CommentsAndTextsAreNoRecords) {
    const std::string text =
        "; Geometry: 7, \"Geometry::no\", \"Mesh\" {\nObjects: { ; {\nNote: \"Geometry: 8 {\"\nGeometry: 9, "
        "\"Geometry::yes\", \"Mesh\" {\nGeometry: 10, \"Geometry::no\", \"Mesh\"\n}\n}\n";
    EXPECT_EQ(noteLostGeometries(text), Notes{"1 mesh that no connection leads to the scene is left out: \"yes\""});
}

// A box in a scaled node, and a tetrahedron in a node with properties below that.
std::string fbxWithChild(const std::string& properties, const std::string& parent_scale = "1,2,1") {
    const std::string child = withReplaced(model(201), "Shading: T", "Properties70: {\n" + properties + "}\nShading: T");
    const std::string file = fbxWith(geometry(101, "extra") + child, "C: \"OO\",101,201\nC: \"OO\",201,200\n");
    return withReplaced(file, "\"A\",1.000000,1.000000,1.000000", "\"A\"," + parent_scale);
}

std::string turn(const std::string& key, const std::string& degrees) {
    return "P: \"" + key + "\", \"Vector3D\", \"Vector\", \"\"," + degrees + "\n";
}
std::string inherit(int type) { return "P: \"InheritType\", \"enum\", \"\", \"\"," + std::to_string(type) + "\n"; }

TEST(FbxNodes, WhoseScaleIsInheritedOtherwiseAreNamed) {
    const Notes note = {"the scale is inherited as by InheritType 1 (RSrs) although the file has another, at 1 node: \"m\""};
    const std::string quarter = turn("Lcl Rotation", "0,0,90");
    for (const int type : {0, 2})
        EXPECT_EQ(notesOf(fbxWithChild(quarter + inherit(type)), ".fbx"), note) << type;
    EXPECT_EQ(notesOf(fbxWithChild(turn("PreRotation", "45,0,0") + inherit(0)), ".fbx"), note);
    EXPECT_EQ(notesOf(fbxWithChild(turn("Lcl Rotation", "10,20,30") + inherit(0)), ".fbx"), note);
    EXPECT_EQ(notesOf(fbxWithChild(inherit(2), "100,100,100"), ".fbx"), note);
}

TEST(FbxNodes, WhoseShapeIsTheSameByEachTypeOfInheritanceAreNotNamed) {
    const std::string quarter = turn("Lcl Rotation", "0,0,90");
    EXPECT_EQ(notesOf(fbxWithChild(quarter), ".fbx"), Notes{});
    EXPECT_EQ(notesOf(fbxWithChild(quarter + inherit(1)), ".fbx"), Notes{});
    EXPECT_EQ(notesOf(fbxWithChild(quarter + inherit(0), "100,100,100"), ".fbx"), Notes{});
    EXPECT_EQ(notesOf(fbxWithChild(quarter + inherit(2), "1,1,1"), ".fbx"), Notes{});
    EXPECT_EQ(notesOf(fbxWithChild(turn("Lcl Rotation", "0,37,-180") + inherit(0)), ".fbx"), Notes{});
}

TEST(FbxNodes, WithoutMeshesAreNotNamed) {
    const std::string odd = turn("Lcl Rotation", "0,0,90") + inherit(0);
    const std::string file = withReplaced(fbxWithChild(odd), "C: \"OO\",101,201\n", "C: \"OO\",101,200\n");
    EXPECT_EQ(notesOf(file, ".fbx"), Notes{});
}

TEST(FbxNodes, ThatAreTurnedWithoutAnActiveRotationAreNamed) {
    const std::string inactive = "P: \"RotationActive\", \"bool\", \"\", \"\",0\n";
    for (const char* key : {"PreRotation", "PostRotation"})
        EXPECT_EQ(notesOf(fbxWithChild(turn(key, "-90,0,0") + inactive), ".fbx"),
                  Notes{"PreRotation and PostRotation are applied although RotationActive is 0, at 1 node: \"m\""});
    EXPECT_EQ(notesOf(fbxWithChild(turn("PreRotation", "0,0,0") + inactive), ".fbx"), Notes{});
    EXPECT_EQ(notesOf(fbxWithChild(turn("PreRotation", "-90,0,0")), ".fbx"), Notes{});
}

TEST(FbxObjects, BlendShapesWithAWeightAreNamed) {
    const auto shape = [](const std::string& content) {
        return fbxWith("Deformer: 301, \"SubDeformer::smile\", \"BlendShapeChannel\" {\nVersion: 100\n" + content + "}\n", "");
    };
    const Notes note = {"1 blend shape with a DeformPercent other than 0 is left out: \"smile\""};
    EXPECT_EQ(notesOf(shape("DeformPercent: 0.5\n"), ".fbx"), note);
    EXPECT_EQ(notesOf(shape("Properties70: {\nP: \"DeformPercent\", \"Number\", \"\", \"A\",100\n}\n"), ".fbx"), note);
    EXPECT_EQ(notesOf(shape("DeformPercent: 0\nFullWeights: *1 {\na: 100\n}\n"), ".fbx"), Notes{});
}

// ---- binary FBX -------------------------------------------------------------------------------------------------------------

template <class T>
std::string bytesOf(T value) {
    return {reinterpret_cast<const char*>(&value), sizeof value};
}

std::string integer(int64_t value) { return "L" + bytesOf(value); }
std::string real(double value) { return "D" + bytesOf(value); }
std::string text(const std::string& value) { return "S" + bytesOf(static_cast<uint32_t>(value.size())) + value; }

// Writes records as of version 7.4 with 32-bit offsets, or as of 7.5 with 64 bits.
class BinaryFbx {
public:
    explicit BinaryFbx(bool is_wide) : is_wide_(is_wide) {
        bytes_ = std::string("Kaydara FBX Binary  \0\x1A\0", 23) + bytesOf<uint32_t>(is_wide ? 7500 : 7400);
    }
    template <class Children>
    void add(const std::string& key, const std::vector<std::string>& values, const Children& add_children) {
        std::string joined;
        for (const std::string& value : values)
            joined += value;
        const size_t begin = bytes_.size();
        bytes_ += word(0) + word(values.size()) + word(joined.size()) + static_cast<char>(key.size()) + key + joined;
        const size_t before = bytes_.size();
        add_children();
        if (bytes_.size() > before) bytes_ += end();
        const std::string end_offset = word(bytes_.size());
        bytes_.replace(begin, end_offset.size(), end_offset);
    }
    void add(const std::string& key, const std::vector<std::string>& values) {
        add(key, values, [] {});
    }
    std::string file() const { return bytes_ + end(); }

private:
    std::string word(uint64_t value) const { return is_wide_ ? bytesOf(value) : bytesOf(static_cast<uint32_t>(value)); }
    std::string end() const { return word(0) + word(0) + word(0) + '\0'; }

    bool is_wide_;
    std::string bytes_;
};

std::string binaryFbx(bool is_wide) {
    const auto name = [](const std::string& of) { return text(of + std::string("\0\1Geometry", 10)); };
    BinaryFbx fbx(is_wide);
    fbx.add("FBXHeaderExtension", {}, [&] { fbx.add("FBXVersion", {"I" + bytesOf(int32_t{7400})}); });
    fbx.add("Objects", {}, [&] {
        const std::string array = "d" + bytesOf(uint32_t{1}) + bytesOf(uint32_t{0}) + bytesOf(uint32_t{8}) + bytesOf(1.0);
        fbx.add("Geometry", {integer(1LL << 40), name("used"), text("Mesh")}, [&] { fbx.add("Vertices", {array}); });
        fbx.add("Geometry", {integer(2), name("lost"), text("Mesh")}, [&] { fbx.add("Vertices", {array}); });
        fbx.add("Geometry", {integer(3), name("wire"), text("NurbsCurve")});
        fbx.add("Model", {integer(4), name("node"), text("Mesh")}, [&] {
            fbx.add("Properties70", {}, [&] {
                fbx.add("P", {text("RotationActive"), text("bool"), text(""), text(""), "I" + bytesOf(int32_t{0})});
                fbx.add("P", {text("PreRotation"), text("Vector3D"), text(""), text("A"), real(0), real(-45), real(0)});
            });
        });
        fbx.add("Deformer", {integer(5), name("smile"), text("BlendShapeChannel")},
                [&] { fbx.add("DeformPercent", {real(1e-9)}); });
    });
    fbx.add("Connections", {}, [&] {
        fbx.add("C", {text("OO"), integer(4), integer(0)});
        fbx.add("C", {text("OO"), integer(1LL << 40), integer(4)});
        fbx.add("C", {text("OP"), integer(2), integer(4), text("Shape")});
    });
    return fbx.file();
}

TEST(FbxObjects, BinaryFilesAreLookedThrough) {
    for (const bool is_wide : {false, true})
        EXPECT_EQ(noteLostGeometries(binaryFbx(is_wide)),
                  (Notes{"PreRotation and PostRotation are applied although RotationActive is 0, at 1 node: \"node\"",
                         "1 blend shape with a DeformPercent other than 0 is left out: \"smile\"",
                         "1 mesh that no connection leads to the scene is left out: \"lost\"",
                         "1 geometry that is no mesh is left out: \"wire\" (NurbsCurve)"}));
}

TEST(FbxObjects, DamagedBinaryFilesDoNoHarm) {
    for (const bool is_wide : {false, true}) {
        const std::string whole = binaryFbx(is_wide);
        for (size_t size = 0; size < whole.size(); ++size)
            noteLostGeometries(std::string_view(whole).substr(0, size));
        for (size_t at = 23; at < whole.size(); ++at)
            for (const char odd : {'\0', '\1', '\x7F', '\xFF'}) {
                std::string spoiled = whole;
                spoiled[at] = odd;
                noteLostGeometries(spoiled);
            }
    }
}

// ---- COLLADA ----------------------------------------------------------------------------------------------------------------

const std::string kPolylist = "<polylist count=\"6\">", kNode = "<node id=\"n\">";

std::string daeWith(const std::string& from, const std::string& to) { return withReplaced(collada("", kSize), from, to); }

// The largest coordinates of a model.
Double3 highestCorner(const std::string& dae) {
    const auto mesh = importMesh(dae, ".dae");
    EXPECT_TRUE(mesh) << mesh.error().message;
    if (!mesh) return {0, 0, 0};
    Double3 highest = mesh->positions.front();
    for (const Double3& position : mesh->positions)
        for (size_t axis = 0; axis < 3; ++axis)
            highest[axis] = std::max(highest[axis], position[axis]);
    return highest;
}

TEST(Collada, SkewedNodesAreRefusedWithTheLine) {
    EXPECT_EQ(refusalOf(daeWith(kNode, kNode + "\n\n<skew sid=\"s\">45 0 1 0 1 0 0</skew>"), ".dae"),
              "line 3: <skew> is not read; apply the transforms of the nodes before export");
    EXPECT_EQ(refusalOf(daeWith(kNode, kNode + "<!-- <skew> --><![CDATA[<skew>]]>"), ".dae"), "");
}

// The corners of the box of 1, 2 and 3 after it is turned about a diagonal by 120 degrees.
TEST(Collada, AxesOfRotationsMayHaveAnyLength) {
    for (const char* rotation : {"1 1 1 120", "\n0.57735 0.57735 0.57735 120 ", "1e30 1e30 1e30 120", "1,5 1,5 1,5 120"})
        EXPECT_LT(length(highestCorner(daeWith(kNode, kNode + "<rotate>" + rotation + "</rotate>")) - Double3{3, 1, 2}), 1e-5)
            << rotation;
    for (const char* rotation : {"0 0 2 0", "0 0 0 0", "0 0 -0.1 360"})
        EXPECT_LT(length(highestCorner(daeWith(kNode, kNode + "<rotate>" + rotation + "</rotate>")) - kSize), 1e-5) << rotation;
}

TEST(Collada, RotationsWithoutADirectionAreRefusedWithTheLine) {
    for (const char* axis : {"0 0 0", "nan 0 1", "inf 0 0"})
        EXPECT_EQ(refusalOf(daeWith(kNode, kNode + "\n<rotate>" + axis + " 90</rotate>"), ".dae"),
                  "line 2: the axis of a <rotate> has no direction; give it an axis other than 0 0 0, or remove it")
            << axis;
}

TEST(Collada, LookatsWithoutADirectionAreRefusedWithTheLine) {
    for (const char* lookat : {"1 2 3 1 2 3 0 1 0", "0 0 0 0 5 0 0 1 0", "0 0 0 0 0 -1 0 0 0"})
        EXPECT_EQ(refusalOf(daeWith(kNode, kNode + "\n<lookat>" + lookat + "</lookat>"), ".dae"),
                  "line 2: a <lookat> without a direction, or whose up is parallel to it; replace it by a <matrix>")
            << lookat;
    EXPECT_NEAR(volumeOf(daeWith(kNode, kNode + "<lookat>1 2 3 1 2 10 0 1 0</lookat>"), ".dae"), 6, 1e-5);
}

TEST(Collada, NodesThatAScaleOfZeroMakesFlatAreLeftOut) {
    const std::string note = "1 node that a scale of 0 makes flat is left out: ";
    EXPECT_EQ(refusalOf(daeWith(kNode, "<node id=\"m\"><scale>1 0 1</scale><rotate>1 1 1 50</rotate>"), ".dae"),
              "no triangles in it (" + note + "\"m\"); export the model with its meshes");
    const std::string flat = "<node id=\"m\"><scale>0 0 0</scale><node id=\"k\"><instance_geometry url=\"#g\"/></node></node>";
    EXPECT_EQ(notesOf(daeWith(kNode, flat + kNode), ".dae"), Notes{note + "\"k\""});
}

TEST(Collada, TriangleFansAreRefusedWithTheLine) {
    const std::string fan =
        "\n<trifans count=\"1\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 2 3 1</p></trifans>";
    EXPECT_EQ(refusalOf(daeWith("</polylist>", "</polylist>" + fan), ".dae"),
              "line 2: triangle fans (<trifans>) are not read; export triangles");
}

TEST(Collada, UpAxesAreReadBesideBlanksAndComments) {
    for (const char* axis : {"Z_UP ", "\n  Z_UP\n", "<!-- up -->Z_UP", "Z_UP<!-- <up_axis>Y_UP</up_axis> -->"}) {
        const std::string file = collada(std::string("<up_axis>") + axis + "</up_axis>", kSize);
        EXPECT_EQ(notesOf(file, ".dae"), Notes{"z up: turned so that y is up"}) << axis;
        EXPECT_NEAR(highestCorner(file)[1], 3, 1e-6) << axis;
    }
}

TEST(Collada, CommentsAmongNumbersAreSkipped) {
    EXPECT_EQ(highestCorner(daeWith(kNode, kNode + "<translate>1<!-- x --> 2 <!-- y\n -->3</translate>")), (Double3{2, 4, 6}));
    EXPECT_NEAR(volumeOf(daeWith("<p>0 2 3 1", "<p><!-- a -->0 2 <!-- b --> 3 1"), ".dae"), 6, 1e-6);
    EXPECT_EQ(refusalOf(daeWith(kNode, kNode + "<!-- \n\n --><skew>45 0 1 0 1 0 0</skew>"), ".dae").substr(0, 7), "line 3:");
    EXPECT_NE(refusalOf(daeWith(kNode, kNode + "<!-- without an end"), ".dae"), "");
}

std::string skin(const std::string& matrix) {
    return "<library_controllers><controller id=\"c\"><skin source=\"#g\"><bind_shape_matrix>" + matrix +
           "</bind_shape_matrix></skin></controller></library_controllers><library_visual_scenes>";
}

TEST(Collada, MatricesOfSkinsAreNoted) {
    const auto notes = [](const std::string& matrix) {
        return notesOf(daeWith("<library_visual_scenes>", skin(matrix)), ".dae");
    };
    EXPECT_EQ(notes("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"), Notes{});
    EXPECT_EQ(notes("2 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"), Notes{"1 bind_shape_matrix of a controller is left out: \"c\""});
}

TEST(Collada, MorphsAreRefusedWithTheLine) {
    const std::string morph =
        "<library_controllers><controller id=\"c\">\n<morph source=\"#g\" method=\"NORMALIZED\"/></controller>"
        "</library_controllers><library_visual_scenes>";
    EXPECT_EQ(refusalOf(daeWith("<library_visual_scenes>", morph), ".dae"),
              "line 2: <morph> controllers are not read; apply the shapes to the mesh before export");
}

TEST(Collada, PolygonsWithHolesAreRefusedWithTheLine) {
    const std::string polygons = "<polygons count=\"1\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>\n<ph><p>0 2 3 "
                                 "1</p><h>4 5 7</h></ph></polygons>";
    EXPECT_EQ(refusalOf(daeWith("</polylist>", "</polylist>" + polygons), ".dae"),
              "line 2: a polygon with holes; triangulate the model before export");
}

TEST(Collada, PrimitivesWithoutACountAreRefusedWithTheLine) {
    for (const char* bad : {"<polylist>", "<polylist count=\"0\">", "<polylist count=\"x\">", "<polylist account=\"6\">"})
        EXPECT_EQ(refusalOf(daeWith(kPolylist, bad), ".dae"), "line 1: primitives without a count; export the file again")
            << bad;
    EXPECT_EQ(refusalOf(daeWith(kPolylist, "<polylist material='m' count = '6'>"), ".dae"), "");
}

TEST(Collada, NegativeIndicesAreRefusedWithTheLine) {
    EXPECT_EQ(refusalOf(daeWith("<p>0 2 3 1", "\n<p>-1 2 3 1"), ".dae"), "line 2: a negative index; export the file again");
}

TEST(Collada, AccessorsBeyondTheirArraysAreRefusedWithTheLine) {
    const std::string stride = "count=\"8\" stride=\"3\"", array = "<float_array id=\"a\" count=\"24\">";
    EXPECT_EQ(refusalOf(daeWith(stride, "count=\"8\" stride=\"4\""), ".dae"),
              "line 1: an accessor of 8 elements reaches beyond its array of 24 numbers; export the file again");
    EXPECT_EQ(refusalOf(daeWith(stride, "offset=\"1\" " + stride), ".dae"),
              "line 1: an accessor of 8 elements reaches beyond its array of 24 numbers; export the file again");
    EXPECT_EQ(refusalOf(daeWith(array, "\n<float_array id=\"a\" count=\"21\">"), ".dae"),
              "line 2: an accessor of 8 elements reaches beyond its array of 21 numbers; export the file again");
    EXPECT_EQ(refusalOf(daeWith(array, "<float_array id=\"a\" count=\"25\">"), ".dae"),
              "line 1: float_array has 24 numbers, its count is 25; the file is damaged, export it again");
    EXPECT_EQ(refusalOf(daeWith("<param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" ",
                                "<param type=\"float\"/><param type=\"float\"/><param "),
                        ".dae"),
              "line 1: an accessor whose params have no names, such as X, Y and Z; export the file again");
}

TEST(Collada, NumbersBehindTheCountOfAnArrayAreNoted) {
    const std::string file = daeWith("</float_array>", " 7 8 9</float_array>");
    EXPECT_NEAR(volumeOf(file, ".dae"), 6, 1e-6);
    EXPECT_EQ(notesOf(file, ".dae"), Notes{"numbers behind those that an array counts are left out: 1 array"});
}

TEST(Collada, NumbersMayHaveADecimalCommaAndNothingElse) {
    const std::string file = collada("", {1.5, 2, 3});
    std::string commas = file;
    for (size_t at = commas.find("1.500000"); at != commas.npos; at = commas.find("1.500000"))
        commas[at + 1] = ',';
    ASSERT_NE(commas, file);
    EXPECT_NEAR(volumeOf(commas, ".dae"), 9, 1e-6);
    EXPECT_EQ(refusalOf(daeWith("count=\"24\">0.000000 ", "count=\"24\">\n0,1,2 "), ".dae"),
              "line 2: an array holds something that is not a number; export the file again");
}

TEST(Collada, MatricesMustBeAffine) {
    const std::string rows = "<matrix>1 0 0 5 0 1 0 0 0 0 1 0 ";
    EXPECT_EQ(refusalOf(daeWith(kNode, kNode + rows + "0 0 0 1</matrix>"), ".dae"), "");
    EXPECT_EQ(refusalOf(daeWith(kNode, kNode + "\n" + rows + "0 0 1 1</matrix>"), ".dae"),
              "line 2: a matrix must end in the row 0 0 0 1; export the file again");
    EXPECT_NE(refusalOf(daeWith(kNode, kNode + rows + "0 0</matrix>"), ".dae"), "");
}

// Warnings about lamps are left out, but not those about meshes that are named like one.
TEST(Collada, LostMeshesNamedLikeALampAreNoted) {
    const std::string instance = "<instance_geometry url=\"#g\"/>";
    const auto mesh = importMesh(daeWith(instance, instance + "<instance_geometry url=\"#LightTexture\"/>"), ".dae");
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_TRUE(std::ranges::any_of(mesh->notes, [](const auto& note) { return note.find("LightTexture") != note.npos; }));
}

TEST(Collada, GeometriesThatNoNodeShowsAreNamed) {
    const std::string more = "<geometry id=\"a&amp;b\"><spline closed=\"true\"/></geometry>";
    const std::string file = daeWith("</library_geometries>", more + "</library_geometries>");
    EXPECT_EQ(notesOf(file, ".dae"), Notes{"1 geometry without a mesh in the scene is left out: a&b"});
    EXPECT_NEAR(volumeOf(file, ".dae"), 6, 1e-6);
}

// Assimp would make up a mesh of the nodes.
TEST(Collada, AFileWithoutShownGeometriesIsRefused) {
    EXPECT_EQ(refusalOf(daeWith("<instance_geometry url=\"#g\"/>", ""), ".dae"),
              "no triangles in it (1 geometry without a mesh in the scene is left out: g); export the model with its meshes");
}

TEST(Collada, OtherScenesAreNoted) {
    const std::string other = "<visual_scene id=\"t\"><node><instance_geometry url=\"#g\"/></node></visual_scene>";
    const std::string file = daeWith("</library_visual_scenes>", other + "</library_visual_scenes>");
    EXPECT_EQ(notesOf(file, ".dae"), Notes{"1 other scene is left out"});
    EXPECT_NEAR(volumeOf(file, ".dae"), 6, 1e-6);
}

TEST(Collada, LinesAreNoted) {
    const std::string lines =
        "<lines count=\"2\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 2 3</p></lines>";
    EXPECT_EQ(notesOf(daeWith("</polylist>", "</polylist>" + lines), ".dae"),
              Notes{"points, lines and faces of one or two corners are left out: 2"});
}

// An exporter for Blender, of which models for Godot come, writes colors so.
TEST(Collada, BlanksBeforeNumbersAreSkipped) {
    const std::string effects =
        "<library_effects><effect id=\"e\"><profile_COMMON><technique sid=\"t\"><blinn><emission><color>  0.0 "
        "0.0 0.0 1.0  </color></emission></blinn></technique></profile_COMMON></effect></library_effects>";
    std::string text = collada("<up_axis>Y_UP</up_axis>", {1, 2, 3});
    text.insert(text.find("<library_geometries>"), effects);
    EXPECT_NEAR(volumeOf(text, ".dae"), 6, 1e-6);
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
    for (const char c : collada("", kSize))
        wide += std::string{c, '\0'};
    EXPECT_EQ(refusalOf(wide, ".dae"), "saved as UTF-16; save it as ASCII or UTF-8");
}

} // namespace
