// STL, binary and text. Its triangles share nothing: vertices are joined later, by position. Its normals are those of the
// facets and say nothing that the corners do not.
#include "modules/brittle/mesh/readers.h"
#include "modules/brittle/mesh/text_reader.h"

#include <algorithm>
#include <cstring>

namespace brittle {
namespace {

constexpr size_t kHeaderBytes = 84, kTriangleBytes = 50;

// Adds facets to a mesh. Corners that repeat the next one are left out of polygons; a triangle that has some is counted as
// collapsed later.
class FacetBuilder {
public:
    const char* add(std::span<const Double3> corners);
    ImportedMesh take() { return mesh_.take(); }

private:
    MeshBuilder mesh_;
    std::vector<PolygonCorner> polygon_;
};

const char* FacetBuilder::add(std::span<const Double3> corners) {
    polygon_.clear();
    for (size_t k = 0; k < corners.size(); ++k) {
        if (corners.size() > 3 && corners[k] == corners[(k + 1) % corners.size()]) continue;
        polygon_.emplace_back().position = static_cast<uint32_t>(mesh_.vertexCount());
        mesh_.addVertex(corners[k]);
    }
    return mesh_.addPolygon(polygon_);
}

uint32_t promisedTriangles(std::string_view bytes) {
    uint32_t count = 0;
    std::memcpy(&count, bytes.data() + kHeaderBytes - 4, 4);
    return count;
}

// The 32-bit count times 50 cannot overflow.
uint64_t promisedBytes(std::string_view bytes) { return kHeaderBytes + uint64_t{promisedTriangles(bytes)} * kTriangleBytes; }

// How many triangles a binary file holds, and a note where its header says otherwise.
struct BinarySize {
    size_t triangles = 0;
    std::string note;
    bool has_attributes = false; // as many bytes behind every triangle as its last two bytes count
};

size_t attributeBytes(std::string_view bytes, size_t triangle_begin) {
    uint16_t count = 0;
    std::memcpy(&count, bytes.data() + triangle_begin + kTriangleBytes - 2, 2);
    return count;
}

// Most programs that fill these two bytes store a color there, and nothing follows. Some do store bytes, which then add up.
bool endsBehindAttributes(std::string_view bytes) {
    size_t at = kHeaderBytes;
    for (uint32_t t = 0; t < promisedTriangles(bytes); ++t) {
        if (at + kTriangleBytes > bytes.size()) return false;
        at += kTriangleBytes + attributeBytes(bytes, at);
    }
    return at == bytes.size();
}

// nullopt where header and length do not go together. Programs that write in one go leave 0 or -1 as the count: then the
// length tells. Bytes that follow are left out, unless they may be triangles.
std::optional<BinarySize> binarySize(std::string_view bytes) {
    if (bytes.size() < kHeaderBytes) return std::nullopt;
    const size_t data = bytes.size() - kHeaderBytes, held = data / kTriangleBytes;
    const uint32_t promised = promisedTriangles(bytes);
    if (promisedBytes(bytes) == bytes.size()) return BinarySize{promised, ""};
    const bool is_whole = data % kTriangleBytes == 0;
    if ((promised == 0 || promised == UINT32_MAX) && is_whole)
        return BinarySize{held, "the header counts " + std::to_string(promised) + " triangles; all " + std::to_string(held) +
                                    " of the file are read"};
    if (promised <= held && endsBehindAttributes(bytes))
        return BinarySize{promised, "attributes of triangles are left out", true};
    const bool has_all = promised > 0 && promised <= held;
    if (!has_all || is_whole || data > 2 * promised * kTriangleBytes) return std::nullopt;
    return BinarySize{promised,
                      std::to_string(bytes.size() - promisedBytes(bytes)) + " bytes after the last triangle are left out"};
}

engine::Result<ImportedMesh> readBinary(std::string_view bytes, const BinarySize& size) {
    FacetBuilder mesh;
    size_t begin = kHeaderBytes;
    for (size_t t = 0; t < size.triangles; ++t) {
        std::array<float, 9> numbers;
        std::memcpy(numbers.data(), bytes.data() + begin + 12, sizeof numbers);
        std::array<Double3, 3> corners;
        for (size_t k = 0; k < 9; ++k) {
            if (!std::isfinite(numbers[k]))
                return badInput("triangle " + std::to_string(t) + " (byte " + std::to_string(begin) + "): " + kNotFinite);
            corners[k / 3][k % 3] = static_cast<double>(numbers[k]);
        }
        begin += kTriangleBytes + (size.has_attributes ? attributeBytes(bytes, begin) : 0);
        mesh.add(corners);
    }
    ImportedMesh read = mesh.take();
    if (!size.note.empty()) read.notes.push_back(size.note);
    return read;
}

// Text as many programs write it: words in either case, "end solid" for "endsolid", anything before the first "solid" and
// behind a name. Only what holds the corners counts.
class StlTextReader {
public:
    explicit StlTextReader(std::string_view bytes) : text_(bytes) {}
    engine::Result<ImportedMesh> run();

private:
    // nullptr where all is well, else what is wrong with the line.
    const char* readWord(std::string_view word);
    const char* readVertex();
    const char* beginLoop();
    const char* endFacet();
    const char* endSolid();
    void skipName();

    TextReader text_;
    FacetBuilder mesh_;
    std::vector<Double3> corners_; // of the current facet
    size_t loop_count_ = 0;        // of the current facet
    bool has_ended_ = false;       // the solid
    LeftOut polygons_;
};

engine::Result<ImportedMesh> StlTextReader::run() {
    for (std::string_view word = text_.nextWord(); !word.empty(); word = text_.nextWord())
        if (const char* wrong = readWord(word)) return badLine(text_.line(), wrong);
    if (!corners_.empty()) return badLine(text_.line(), "ends within a facet; the file was cut short, copy or export it again");
    ImportedMesh mesh = mesh_.take();
    if (!has_ended_) mesh.notes.push_back("the file ends without endsolid; it may have been cut short");
    if (polygons_.count() > 0)
        mesh.notes.push_back("facets of more than three corners are cut into triangles: " + polygons_.described("facet"));
    return mesh;
}

const char* StlTextReader::readWord(std::string_view word) {
    const bool has_blank = isWord(word, "end"); // within "end solid"
    if (has_blank) word = text_.nextWord();
    const auto ends = [&](std::string_view name, std::string_view end_name) {
        return isWord(word, has_blank ? name : end_name);
    };
    if (ends("solid", "endsolid")) return endSolid();
    if (ends("facet", "endfacet")) return endFacet();
    if (isWord(word, "outer") || isWord(word, "inner")) return beginLoop();
    if (isWord(word, "vertex")) return readVertex();
    if (isWord(word, "facet") && !corners_.empty()) return "a facet that does not end; export the file again";
    if (isWord(word, "solid")) {
        has_ended_ = false;
        skipName();
    }
    return nullptr;
}

const char* StlTextReader::readVertex() {
    Double3& point = corners_.emplace_back();
    if (corners_.size() > kMaxPolygonCorners) return "a facet of more than 10,000 corners; export the file again";
    for (double& coordinate : point) {
        const std::string_view word = text_.nextWord();
        const auto number = parseNumber(word);
        if (!number) return hasComma(word) ? kDecimalComma : "a vertex needs three numbers";
        if (!std::isfinite(*number)) return kNotFinite;
        coordinate = *number;
    }
    return nullptr;
}

const char* StlTextReader::beginLoop() {
    return ++loop_count_ > 1 ? "a facet of several loops; cut it into triangles before export" : nullptr;
}

const char* StlTextReader::endFacet() {
    if (corners_.size() < 3) return "a facet has fewer than three vertices";
    if (corners_.size() > 3) polygons_.add(text_.line());
    const char* wrong = mesh_.add(corners_);
    corners_.clear();
    loop_count_ = 0;
    return wrong;
}

const char* StlTextReader::endSolid() {
    if (!corners_.empty()) return "a facet that does not end; export the file again";
    has_ended_ = true;
    skipName();
    return nullptr;
}

// The name ends with the line. Some programs write no line ends: then it ends before the first facet, of this solid or of the
// next.
void StlTextReader::skipName() {
    const size_t line = text_.line();
    TextReader ahead = text_;
    for (std::string_view word = ahead.nextWord(); !word.empty() && ahead.line() == line; word = ahead.nextWord()) {
        const std::string_view next = TextReader(ahead).nextWord();
        if (isWord(word, "facet") && (isWord(next, "normal") || isWord(next, "outer"))) {
            has_ended_ = false;
            return;
        }
        text_ = ahead;
    }
}

// Searches the first words for "solid" or "facet". Other words may stand before it.
bool looksLikeText(std::string_view bytes) {
    if (looksBinary(bytes.substr(std::min(bytes.size(), kHeaderBytes)))) return false; // names may be padded with zeros
    TextReader start(bytes.substr(0, 4096));
    for (std::string_view word = start.nextWord(); !word.empty(); word = start.nextWord())
        if (isWord(word, "solid") || isWord(word, "facet")) return true;
    return false;
}

engine::Error neitherTextNorBinary(std::string_view bytes) {
    if (isUtf16(bytes)) return badInput(kUtf16);
    if (bytes.size() < kHeaderBytes) return badInput("too short for an STL file; copy or export it again");
    return badInput("its header promises " + std::to_string(promisedTriangles(bytes)) + " triangles in " +
                    std::to_string(promisedBytes(bytes)) + " bytes but it has " + std::to_string(bytes.size()) +
                    "; the file is damaged or not STL, copy or export it again");
}

} // namespace

// Binary files may begin with "solid" too: their length is what gives them away.
engine::Result<ImportedMesh> readStl(std::string_view bytes) {
    const auto size = binarySize(bytes);
    const std::string_view text = withoutPadding(bytes);
    if (!size && !looksLikeText(text)) return neitherTextNorBinary(bytes);
    auto mesh = size ? readBinary(bytes, *size) : StlTextReader(text).run();
    if (mesh && mesh->triangles.empty()) return badInput("no triangles in it; export the model again");
    return mesh;
}

} // namespace brittle
