// OBJ and STL files as many programs write them: read for what they mean, or refused with the line.
#include "modules/brittle/mesh/readers.h"
#include "modules/brittle/mesh/vector_math.h"
#include "tests/module/file_variant.h"

#include <gtest/gtest.h>

#include <cstring>

using namespace brittle;

namespace {

const std::string kCorners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
const std::string kFaces = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
const std::string kTetrahedron = kCorners + kFaces;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

// Every second byte is zero.
std::string utf16(const std::string& text, bool has_mark) {
    std::string wide = has_mark ? "\xFF\xFE" : "";
    for (const char c : text)
        wide += std::string{c, '\0'};
    return wide;
}

std::vector<Variant> objVariants() {
    const std::string attributes = "vt 0 0\nvn 0 0 1\n";
    return {
        // Attributes that lead nowhere.
        {"NormalZero", ".obj", kCorners + attributes + replaced(kFaces, " 4", " 4/1/0"), "",
         "normals that are not in the file"},
        {"NormalBeyond", ".obj", kCorners + attributes + replaced(kFaces, " 4", " 4//7"), "", "3 corners (first in line 8)"},
        {"NormalFarBehind", ".obj", kCorners + attributes + replaced(kFaces, " 4", " 4//-2"), "", "normals that are not"},
        {"UvZero", ".obj", kCorners + attributes + replaced(kFaces, " 4", " 4/0/1"), "", "texture coordinates that are not"},
        {"UvsWithoutAny", ".obj", kCorners + replaced(kFaces, " 4", " 4/4"), "",
         "texture coordinates that are not in the file"},
        {"UvHuge", ".obj", kCorners + replaced(kFaces, " 4", " 4/99999999999999999999"), "", "texture coordinates that are"},
        {"EmptyAttributes", ".obj", kCorners + replaced(kFaces, " 4", " 4//")},
        {"NormalIsNoIndex", ".obj", kCorners + replaced(kFaces, " 4", " 4//x"),
         "line 6: a face holds something that is not an"},
        {"PositionZero", ".obj", kCorners + replaced(kFaces, " 4", " 0"),
         "line 6: a face refers to a vertex that is not there"},
        {"PositionBeyond", ".obj", kTetrahedron + "f 1 2 5", "line 9: a face refers to a vertex that is not there"},
        {"CapitalV", ".obj", replaced(kTetrahedron, "v ", "V "),
         "lines that are not OBJ are left out: 4 lines (first in line 1)"},
        {"ZeroByte", ".obj", kCorners + std::string(1, '\0') + kFaces, "line 5: binary data where OBJ text was expected"},
        {"DecimalIndex", ".obj", kCorners + replaced(kFaces, " 4", " 4.0"), "line 6: a face holds something that is not"},
        // Order.
        {"NegativeIndices", ".obj", kCorners + "f -4 -2 -3\nf -4 -3 -1\nf -3 -2 -1\nf -4 -1 -2\n"},
        {"FacesFirst", ".obj", kFaces + kCorners},
        {"ContinuedFacesFirst", ".obj", replaced(kFaces, "f 1 ", "f \\\n 1 ") + kCorners},
        {"NormalsLast", ".obj", kCorners + replaced(kFaces, " 4", " 4//1") + "vn 0 0 1\n"},
        {"FacesOfTwoCorners", ".obj", kCorners + "f 1 2\n" + kFaces + "f 3\n", "",
         "faces of fewer than three corners are left out: 2 faces (first in line 5)"},
        {"OldFaces", ".obj", kCorners + replaced(kFaces, "f ", "fo ")},
        // Lines and blanks.
        {"Tabs", ".obj", replaced(kTetrahedron, " ", "\t")},
        {"LeadingBlanks", ".obj", "  " + replaced(kTetrahedron, "\n", "\n   ")},
        {"MixedLineEnds", ".obj", replaced(kCorners, "\n", "\r\n") + "\r" + kFaces},
        {"DoubledCarriageReturns", ".obj", replaced(kTetrahedron, "\n", "\r\r\n")},
        {"Padded", ".obj", kTetrahedron + std::string(9, '\0') + "\x1A"},
        {"ByteOrderMark", ".obj", "\xEF\xBB\xBF" + kTetrahedron},
        {"Continued", ".obj", kCorners + replaced(kFaces, "f 1 ", "f \\\n 1 \\  \n")},
        {"CommentWithBackslash", ".obj", "# made of C:\\models\\\n" + kTetrahedron},
        {"FolderWithBackslash", ".obj", "mtllib C:\\models\\\n" + kTetrahedron},
        {"CommentBehind", ".obj", replaced(kTetrahedron, "\n", " # f 1 2 9\n")},
        {"CommentTouching", ".obj", replaced(kTetrahedron, "\n", "#\n")},
        {"Utf16", ".obj", utf16(kTetrahedron, true), "saved as UTF-16; save it as ASCII or UTF-8"},
        {"Utf16WithoutMark", ".obj", utf16(kTetrahedron, false), "saved as UTF-16; save it as ASCII or UTF-8"},
        // Numbers.
        {"Colors", ".obj", replaced(kCorners, "\n", " 0.5 0.25 1\n") + kFaces},
        {"Weights", ".obj", replaced(kCorners, "\n", " 1.0\n") + kFaces},
        {"Exponents", ".obj", replaced(kTetrahedron, "v 1 0", "v 1.0E+00 -0e-000") + "\n"},
        {"NoDigitBehindPoint", ".obj", replaced(kTetrahedron, "v 1 0 0", "v 1. +.0 0.")},
        {"Nan", ".obj", replaced(kTetrahedron, "v 1 0", "v 1 nan"), "line 2: a coordinate is not a finite number"},
        {"OldNan", ".obj", replaced(kTetrahedron, "v 1 0", "v 1 -1.#IND"), "line 2: a coordinate is not a finite number"},
        {"Infinity", ".obj", replaced(kTetrahedron, "v 1 0", "v inf 0"), "line 2: a coordinate is not a finite number"},
        {"Comma", ".obj", replaced(kTetrahedron, "v 1 0", "v 1,5 0"), "line 2: a number with a comma; write decimal points"},
        {"LostLineEnd", ".obj", replaced(kTetrahedron, "v 1 0 0\n", "v 1 0 0 "), "line 2: a vertex is followed by something"},
        {"CommaInNormal", ".obj", kTetrahedron + "vn 0,5 0 0", "line 9: a number with a comma"},
        {"CommaInUv", ".obj", kTetrahedron + "vt 0,5", "line 9: a number with a comma"},
        // Statements other than polygons.
        {"OddNames", ".obj", "o v 1 2\ng \nusemtl f 1 2 3\ns off\nmtllib a#b c.mtl\n" + kTetrahedron},
        {"Lines", ".obj", kTetrahedron + "l 1 2\nl 2 3\n", "", "lines are left out: 2 statements (first in line 9)"},
        {"Points", ".obj", kTetrahedron + "p 1\n", "", "points are left out: 1 statement (in line 9)"},
        {"Surface", ".obj", kTetrahedron + "cstype bspline\ndeg 1 1\nsurf 0 1 0 1 1 2 3 4\nparm u 0 1\nend\n", "",
         "curves and surfaces are left out"},
        {"OnlySurface", ".obj", kCorners + "surf 0 1 0 1 1 2 3 4\n",
         "1 statement (in line 5) of curves and surfaces but no faces"},
        {"OnlyLines", ".obj", kCorners + "l 1 2\n", "4 vertices with lines or points but no faces"},
        {"OnlyVertices", ".obj", kCorners, "4 vertices but no faces"},
        {"Unknown", ".obj", kTetrahedron + "Face 1 2 3\n", "", "lines that are not OBJ are left out: 1 line (in line 9)"},
    };
}

using Triangle = std::array<float, 9>;

constexpr Triangle kTriangles[] = {
    {0, 0, 0, 0, 1, 0, 1, 0, 0}, {0, 0, 0, 1, 0, 0, 0, 0, 1}, {1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0, 0, 0, 1, 0, 1, 0}};

// `behind` follows every triangle.
std::string binaryStl(uint32_t count, const char* header, uint16_t attribute = 0, const std::string& behind = "") {
    std::string bytes(80, '\0');
    std::memcpy(bytes.data(), header, std::strlen(header));
    bytes.append(reinterpret_cast<const char*>(&count), 4);
    for (const Triangle& t : kTriangles) {
        bytes.append(12, '\0');
        bytes.append(reinterpret_cast<const char*>(t.data()), sizeof t);
        bytes.append(reinterpret_cast<const char*>(&attribute), 2);
        bytes += behind;
    }
    return bytes;
}

std::string facets(size_t first, size_t last) {
    std::string text;
    for (size_t t = first; t < last; ++t) {
        text += "  facet normal 0 0 0\n    outer loop\n";
        for (size_t k = 0; k < 9; k += 3)
            text += "      vertex " + std::to_string(kTriangles[t][k]) + " " + std::to_string(kTriangles[t][k + 1]) + " " +
                    std::to_string(kTriangles[t][k + 2]) + "\n";
        text += "    endloop\n  endfacet\n";
    }
    return text;
}

std::string upperCase(std::string text) {
    for (char& c : text)
        c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    return text;
}

std::vector<Variant> stlTexts() {
    const std::string all = facets(0, 4), text = "solid cube\n" + all + "endsolid cube\n";
    return {
        {"EndSolidApart", ".stl", replaced(text, "endsolid", "end solid")},
        {"AllEndsApart", ".stl", replaced(text, "end", "END ")},
        {"BlanksBefore", ".stl", " \t" + text},
        {"LinesBefore", ".stl", "\n\n" + text},
        {"WordsBefore", ".stl", "; written by hand\n# a comment\n" + text},
        {"UpperCase", ".stl", upperCase(text)},
        {"MixedCase", ".stl", replaced(replaced(text, "vertex", "Vertex"), "endfacet", "EndFacet")},
        {"NameOfTheFormat", ".stl", replaced(text, "cube", "facet vertex endsolid outer")},
        {"LongName", ".stl", replaced(text, "cube", std::string(400, 'x'))},
        {"PaddedName", ".stl", replaced(text, "solid cube\n ", "solid cube" + std::string(60, '\0') + "\n ")},
        {"NoName", ".stl", replaced(text, " cube", "")},
        {"TwoSolids", ".stl", "solid a\n" + facets(0, 2) + "endsolid a\nsolid b\n" + facets(2, 4) + "endsolid b\n"},
        {"EmptySolidBehind", ".stl", text + "solid\nendsolid\n"},
        {"NoNormals", ".stl", replaced(text, " normal 0 0 0", "")},
        {"MoreWords", ".stl", replaced(text, "outer loop", "color 1 0 0 outer loop")},
        {"CarriageReturns", ".stl", replaced(text, "\n", "\r\n")},
        {"OldCarriageReturns", ".stl", replaced(text, "\n", "\r")},
        {"OneLine", ".stl", "solid\n" + replaced(all, "\n", " ") + "endsolid"},
        {"NoLineEnds", ".stl", "solid cube" + replaced(all, "\n", " ") + "endsolid cube"},
        {"NoLineEndsOrNormals", ".stl", "solid" + replaced(replaced(all, "\n", " "), "normal 0 0 0", "") + "endsolid"},
        {"TwoSolidsWithoutLineEnds", ".stl",
         replaced("solid a " + facets(0, 2) + "endsolid a solid b " + facets(2, 4) + "endsolid b", "\n", " ")},
        {"NoLineEndsNoEndsolid", ".stl", replaced("solid a " + facets(0, 2) + "endsolid a solid b " + facets(2, 4), "\n", " "),
         "", "the file ends without endsolid"},
        {"NoLineEndsCutShort", ".stl", replaced(text, "\n", " ").substr(0, text.size() - 40), "line 1: ends within a facet"},
        {"ByteOrderMark", ".stl", "\xEF\xBB\xBF" + text},
        {"Padded", ".stl", text + std::string(64, '\0')},
        {"NoEndsolid", ".stl", "solid cube\n" + all, "", "the file ends without endsolid"},
        {"CutWithinFacet", ".stl", text.substr(0, text.size() - 40), "line 27: ends within a facet"},
        {"Quad", ".stl",
         "solid\n" + all + "facet outer loop vertex 5 0 0 vertex 5 0 0 vertex 6 0 0 vertex 5 1 0 endloop endfacet\n" +
             "facet outer loop vertex 5 0 0 vertex 5 1 0 vertex 6 0 0 endloop endfacet\nendsolid",
         "doubled", "facets of more than three corners are cut into triangles: 1 facet (in line 30)"},
        {"SeveralLoops", ".stl", replaced(text, "    endloop", "    endloop outer loop"), "line 7: a facet of several loops"},
        {"TwoCorners", ".stl", "solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nendfacet\nendsolid",
         "line 5: a facet has fewer than"},
        {"Comma", ".stl", replaced(text, "1.0", "1,0"), "line 5: a number with a comma; write decimal points"},
        {"Nan", ".stl", replaced(text, "1.000000", "nan"), "line 5: a coordinate is not a finite number"},
        {"OldNan", ".stl", replaced(text, "1.000000", "1.#QNAN"), "line 5: a coordinate is not a finite number"},
        {"Empty", ".stl", "solid\nendsolid\n", "no triangles in it"},
        {"Utf16", ".stl", utf16(text, true), "saved as UTF-16; save it as ASCII or UTF-8"},
        {"Utf16WithoutMark", ".stl", utf16(text, false), "saved as UTF-16; save it as ASCII or UTF-8"},
    };
}

std::vector<Variant> stlBinaries() {
    const std::string sound = binaryStl(4, "binary");
    return {
        {"Binary", ".stl", sound},
        {"BinarySolid", ".stl", binaryStl(4, "solid part exported")},
        {"BinaryColors", ".stl", binaryStl(4, "COLOR=\xFF\x80\x40\xFF", 0xFC1F)},
        {"BinaryAttributes", ".stl", binaryStl(4, "", 3, "abc"), "", "attributes of triangles are left out"},
        {"BinaryCountZero", ".stl", binaryStl(0, ""), "", "the header counts 0 triangles; all 4 of the file are read"},
        {"BinaryCountUnknown", ".stl", binaryStl(0xffffffff, ""), "", "the header counts 4294967295 triangles; all 4"},
        {"BinaryCountTooLarge", ".stl", binaryStl(5, ""), "its header promises 5 triangles in 334 bytes but it has 284"},
        {"BinaryCountTooSmall", ".stl", binaryStl(3, ""), "its header promises 3 triangles in 234 bytes but it has 284"},
        {"BinaryTrailing", ".stl", sound + "made by hand", "", "12 bytes after the last triangle are left out"},
        {"BinaryTrailingMuch", ".stl", sound + std::string(999, 'x'), "its header promises 4 triangles"},
        {"BinaryCut", ".stl", sound.substr(0, sound.size() - 1), "its header promises 4 triangles in 284 bytes but it has 283"},
    };
}

class FileVariant : public testing::TestWithParam<Variant> {};

TEST_P(FileVariant, IsReadForWhatItMeans) { expectRead(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Obj, FileVariant, testing::ValuesIn(objVariants()), nameOf);
INSTANTIATE_TEST_SUITE_P(StlText, FileVariant, testing::ValuesIn(stlTexts()), nameOf);
INSTANTIATE_TEST_SUITE_P(StlBinary, FileVariant, testing::ValuesIn(stlBinaries()), nameOf);

// A missing attribute is left out for its corner alone.
TEST(FileVariants, OtherAttributesOfAnObjStay) {
    const auto mesh = readObj(kCorners + "vt .5 .25\nvn 0 0 1\nf 1/1/0 3/0/1 2/1/1\n");
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->corner_uvs, (std::vector<Float2>{{.5f, .75f}, {0, 0}, {.5f, .75f}}));
    EXPECT_EQ(mesh->corner_normals, (std::vector<Float3>{{0, 0, 0}, {0, 0, 1}, {0, 0, 1}}));
    EXPECT_EQ(mesh->notes.size(), 2u);
}

} // namespace
