// PLY and OFF files as many programs write them: read for what they mean, or refused with the line.
#include "modules/brittle/mesh/readers.h"
#include "modules/brittle/mesh/vector_math.h"
#include "tests/module/file_variant.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace brittle;

namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

std::string utf16(const std::string& text) {
    std::string wide = "\xFF\xFE";
    for (const char c : text)
        wide += std::string{c, '\0'};
    return wide;
}

constexpr int kCorners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
constexpr int kFaces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

const std::string kVertexHead = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kFaceHead = "element face 4\nproperty list uchar int vertex_indices\n";
const std::string kAscii = "ply\nformat ascii 1.0\n";
const std::string kVertices = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
const std::string kFaceRows = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
const std::string kHead = kAscii + kVertexHead + kFaceHead + "end_header\n";
const std::string kPly = kHead + kVertices + kFaceRows;

template <class T>
void append(std::string& bytes, int value, bool is_big) {
    const T number = static_cast<T>(value);
    std::array<char, sizeof number> raw;
    std::copy_n(reinterpret_cast<const char*>(&number), sizeof number, raw.begin());
    if (is_big) std::reverse(raw.begin(), raw.end());
    bytes.append(raw.data(), raw.size());
}

// `types` names the types of coordinates, of lengths of lists and of indices.
template <class Coordinate, class Length, class Index>
std::string binaryPly(const std::array<std::string, 3>& types, bool is_big, const std::string& line_end = "\n") {
    std::string bytes = std::string("ply\nformat binary_") + (is_big ? "big" : "little") + "_endian 1.0\nelement vertex 4\n";
    for (const char* name : {"x", "y", "z"})
        bytes += "property " + types[0] + " " + name + "\n";
    bytes += "element face 4\nproperty list " + types[1] + " " + types[2] + " vertex_indices\nend_header\n";
    bytes = replaced(bytes, "\n", line_end);
    for (const auto& corner : kCorners)
        for (const int coordinate : corner)
            append<Coordinate>(bytes, coordinate, is_big);
    for (const auto& face : kFaces) {
        append<Length>(bytes, 3, is_big);
        for (const int index : face)
            append<Index>(bytes, index, is_big);
    }
    return bytes;
}

std::vector<Variant> plyTexts() {
    const std::string edge_head = "element edge 1\nproperty int vertex1\nproperty int vertex2\n";
    return {
        {"NoHeight", ".ply", replaced(kHead, "float z", "float height") + kVertices + kFaceRows,
         "element vertex has no property z; export the model again"},
        {"Plain", ".ply", kPly},
        {"OtherListName", ".ply", replaced(kPly, "vertex_indices", "vertex_index")},
        {"Comments", ".ply",
         replaced(replaced(kPly, "element", "comment x\nelement"), "end_h", "obj_info a b\ncomment\nend_h")},
        {"CommentsBetweenRows", ".ply", replaced(kPly, "\n1 0 0\n", "\ncomment 3 4\n1 0 0 comment\n")},
        {"OldBlender", ".ply", replaced(kPly, "element vertex", "Created by Blender3D 247\nelement vertex")},
        {"CarriageReturns", ".ply", replaced(kPly, "\n", "\r\n")},
        {"OldCarriageReturns", ".ply", replaced(kPly, "\n", "\r")},
        {"ByteOrderMark", ".ply", "\xEF\xBB\xBF" + kPly},
        {"UpperCaseMagic", ".ply", replaced(kPly, "ply\n", "PLY\n")},
        {"OtherElements", ".ply",
         kAscii + kVertexHead + edge_head + kFaceHead + "end_header\n" + kVertices + "0 1\n" + kFaceRows, "",
         "elements that are neither vertices nor faces are left out: 1"},
        {"MoreProperties", ".ply",
         replaced(replaced(kHead, "property list", "property uchar flags\nproperty list"), "element face",
                  "property uchar red\nelement face") +
             "0 0 0 9\n1 0 0 9\n0 1 0 9\n0 0 1 9\n1 3 0 2 1\n1 3 0 1 3\n1 3 1 2 3\n1 3 0 3 2\n"},
        {"EmptyFaces", ".ply", replaced(kHead, "face 4", "face 6") + kVertices + "0\n2 1 2\n" + kFaceRows, "",
         "points, lines and faces of one or two corners are left out: 1"},
        {"Trailing", ".ply", kPly + "3 0 1 2\n", "", "bytes after the last element are left out"},
        {"FacesAndStrips", ".ply",
         kAscii + kVertexHead + kFaceHead + "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" +
             kVertices + kFaceRows + "6 0 2 1 3 0 2\n",
         "", "triangle strips are left out"},
        {"ClosedStrip", ".ply",
         kAscii + kVertexHead + "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" + kVertices +
             "6 0 2 1 3 0 2\n"},
        {"StripsInPieces", ".ply",
         kAscii + kVertexHead + "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" + kVertices +
             "9 0 2 1 3 -1 1 3 0 2\n"},
        // Refusals.
        {"PointCloud", ".ply", kAscii + kVertexHead + "end_header\n" + kVertices, "no faces but 4 points in it"},
        {"NoListOfVertices", ".ply", replaced(kPly, "vertex_indices", "corners"), "element face has no list vertex_indices"},
        {"FacesFirst", ".ply", kAscii + kFaceHead + kVertexHead + "end_header\n" + kFaceRows + kVertices,
         "element face stands before element vertex"},
        {"Comma", ".ply", replaced(kPly, "\n1 0 0", "\n0,5 0 0"), "line 11: vertex 1 of 4: a number with a comma"},
        {"Nan", ".ply", replaced(kPly, "\n1 0 0", "\nnan 0 0"), "line 11: vertex 1 of 4: a coordinate is not a finite number"},
        {"IndexBeyond", ".ply", replaced(kPly, "3 1 2 3", "3 1 2 4"), "line 16: face 2 of 4: it refers to a vertex that"},
        {"HalfLength", ".ply", replaced(kPly, "3 1 2 3", "2.5 1 2 3"), "line 16: face 2 of 4: a list whose length is no whole"},
        {"UnknownType", ".ply", replaced(kPly, "float y", "half y"), "line 5: a property of a type that is not known"},
        {"UnknownFormat", ".ply", replaced(kPly, "ascii", "binary"), "line 2: a PLY format that is not known; use ascii"},
        {"UnknownWord", ".ply", replaced(kPly, "property float y", "propert float y"), "line 5: a header line that is not PLY"},
        {"Utf16", ".ply", utf16(kPly), "saved as UTF-16; save it as ASCII or UTF-8"},
    };
}

std::vector<Variant> plyBinaries() {
    const std::string little = binaryPly<float, uint8_t, int32_t>({"float", "uchar", "int"}, false);
    return {
        {"FloatUcharInt", ".ply", little},
        {"Big", ".ply", binaryPly<float, uint8_t, int32_t>({"float", "uchar", "int"}, true)},
        {"DoubleIntUint", ".ply", binaryPly<double, int32_t, uint32_t>({"double", "int", "uint"}, false)},
        {"Float64Uint32Int32", ".ply", binaryPly<double, uint32_t, int32_t>({"float64", "uint32", "int32"}, true)},
        {"CharCharUchar", ".ply", binaryPly<int8_t, int8_t, uint8_t>({"char", "char", "uchar"}, false)},
        {"Int8Uint8Int8", ".ply", binaryPly<int8_t, uint8_t, int8_t>({"int8", "uint8", "int8"}, true)},
        {"ShortUshortShort", ".ply", binaryPly<int16_t, uint16_t, int16_t>({"short", "ushort", "short"}, false)},
        {"Int16Uint16Uint16", ".ply", binaryPly<int16_t, uint16_t, uint16_t>({"int16", "uint16", "uint16"}, true)},
        {"Float32FloatFloat", ".ply", binaryPly<float, float, float>({"float32", "float", "float"}, false)},
        {"CarriageReturns", ".ply", binaryPly<float, uint8_t, int32_t>({"float", "uchar", "int"}, false, "\r\n")},
        {"OldCarriageReturns", ".ply", binaryPly<float, uint8_t, int32_t>({"float", "uchar", "int"}, true, "\r")},
        {"LineEndBehind", ".ply", little + "\r\n"},
        {"Trailing", ".ply", little + "abc", "", "3 bytes after the last element are left out"},
        {"CutShort", ".ply", little.substr(0, little.size() - 1), "face 3 of 4: no number where one was expected"},
    };
}

const std::string kOff = "OFF\n4 4 6\n" + kVertices + kFaceRows;

std::string offWith(const std::string& magic, const std::string& behind_vertices) {
    return magic + "\n4 4 6\n" + replaced(kVertices, "\n", behind_vertices + "\n") + kFaceRows;
}

std::vector<Variant> offVariants() {
    return {
        {"FacesOfTwoCorners", ".off", "OFF\n4 6 0\n" + kVertices + kFaceRows + "2 0 1\n1 2\n", "",
         "points, lines and faces of one or two corners are left out: 2"},
        {"Plain", ".off", kOff},
        {"CountsOnTheFirstLine", ".off", replaced(kOff, "OFF\n", "OFF ")},
        {"CountsTouchTheMagic", ".off", replaced(kOff, "OFF\n", "OFF")},
        {"CountsOnLinesOfTheirOwn", ".off", replaced(kOff, "4 4 6", "4\n4\n6")},
        {"NoEdgeCount", ".off", replaced(kOff, "4 4 6", "4 4")},
        {"NoMagic", ".off", replaced(kOff, "OFF\n", "")},
        {"LowerCase", ".off", replaced(kOff, "OFF\n", "off\n")},
        {"Comments", ".off", "# a\n" + replaced(kOff, "\n", " # b\n#\n\n")},
        {"ColorsOfFaces", ".off", replaced(replaced(kOff, "3 1 2 3", "3 1 2 3 255 0 0"), "3 0 1 3", "3 0 1 3 0.5 1 0 1")},
        {"Colors", ".off", offWith("COFF", " 255 0 0 255")},
        {"Normals", ".off", offWith("NOFF", " 0 0 1")},
        {"NormalsColors", ".off", offWith("CNOFF", " 0 0 1 255 0 0 255")},
        {"ColorsNormals", ".off", offWith("NCOFF", " 0 0 1 255 0 0 255")},
        {"TextureCoordinates", ".off", offWith("STOFF", " 0.5 0.5")},
        {"Everything", ".off", offWith("STCNOFF", " 0 0 1 1 1 1 1 0.5 0.5")},
        {"Weights", ".off", replaced(offWith("4OFF", " 1"), "1 0 0 1", "2 0 0 2")},
        {"ThreeDimensions", ".off", replaced(kOff, "OFF\n", "nOFF\n3\n")},
        {"Padded", ".off", kOff + std::string(9, '\0')},
        {"CarriageReturns", ".off", replaced(kOff, "\n", "\r\n")},
        {"Trailing", ".off", kOff + "3 0 1 2\n", "",
         "lines after the last face that the header counts are left out: from line 11"},
        {"FourDimensions", ".off", replaced(kOff, "OFF\n", "nOFF\n4\n"), "vertices of other than three dimensions"},
        {"WeightZero", ".off", offWith("4OFF", " 0"), "line 3: a coordinate is not a finite number"},
        {"NoWeight", ".off", offWith("4OFF", ""), "line 3: a vertex needs four numbers"},
        {"Binary", ".off", std::string("OFF BINARY\n\0\0\0\4", 15),
         "line 1: binary OFF is not read; export OFF as text, or PLY"},
        {"OtherKind", ".off", replaced(kOff, "OFF", "XOFF"), "line 1: OFF of this kind is not read"},
        {"Comma", ".off", replaced(kOff, "\n1 0 0", "\n1,5 0 0"), "line 4: a number with a comma; write decimal points"},
        {"IndexBeyond", ".off", replaced(kOff, "3 1 2 3", "3 1 2 4"), "line 9: a face refers to vertex 4 of 4"},
        {"Utf16", ".off", utf16(kOff), "saved as UTF-16; save it as ASCII or UTF-8"},
    };
}

class TableVariant : public testing::TestWithParam<Variant> {};

TEST_P(TableVariant, IsReadForWhatItMeans) { expectRead(GetParam()); }

INSTANTIATE_TEST_SUITE_P(PlyText, TableVariant, testing::ValuesIn(plyTexts()), nameOf);
INSTANTIATE_TEST_SUITE_P(PlyBinary, TableVariant, testing::ValuesIn(plyBinaries()), nameOf);
INSTANTIATE_TEST_SUITE_P(Off, TableVariant, testing::ValuesIn(offVariants()), nameOf);

TEST(TableVariants, TextureCoordinatesOfPlyByEveryName) {
    for (const auto& [u, v] : {std::pair{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}}) {
        const std::string names = std::string("property float ") + u + "\nproperty float " + v + "\nelement face";
        const auto mesh = readPly(replaced(kHead, "element face", names) + replaced(kVertices, "\n", " .25 .75\n") + kFaceRows);
        ASSERT_TRUE(mesh) << u;
        EXPECT_EQ(mesh->corner_uvs[3], (Float2{.25f, .25f})) << u;
    }
}

TEST(TableVariants, NormalsOfPlyAndOff) {
    const std::string names = "property double nx\nproperty double ny\nproperty double nz\nelement face";
    const auto ply = readPly(replaced(kHead, "element face", names) + replaced(kVertices, "\n", " 0 0 1\n") + kFaceRows);
    ASSERT_TRUE(ply);
    EXPECT_EQ(ply->corner_normals[5], (Float3{0, 0, 1}));
    const auto off = readOff(offWith("STN4OFF", " 1 0 0 1 .25 .75"));
    ASSERT_TRUE(off);
    EXPECT_EQ(off->corner_normals[5], (Float3{0, 0, 1}));
    EXPECT_EQ(off->corner_uvs[5], (Float2{.25f, .25f}));
}

} // namespace
