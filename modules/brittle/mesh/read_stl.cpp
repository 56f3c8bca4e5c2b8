// STL, binary and text. Its triangles share nothing: vertices are joined later, by position. Its normals are those of the
// facets and say nothing that the corners do not.
#include "modules/brittle/mesh/readers.h"
#include "modules/brittle/mesh/text_reader.h"

#include <cstring>

namespace brittle {
namespace {

constexpr size_t kHeaderBytes = 84, kTriangleBytes = 50;

void addTriangle(MeshBuilder& mesh, const std::array<Double3, 3>& corners) {
    std::array<PolygonCorner, 3> polygon;
    for (size_t k = 0; k < 3; ++k) {
        polygon[k].position = static_cast<uint32_t>(mesh.vertexCount());
        mesh.addVertex(corners[k]);
    }
    mesh.addPolygon(polygon);
}

// Bytes that the count in a binary file asks for; the 32-bit count times 50 cannot overflow.
uint64_t promisedBytes(std::string_view bytes) {
    uint32_t count = 0;
    std::memcpy(&count, bytes.data() + kHeaderBytes - 4, 4);
    return kHeaderBytes + uint64_t{count} * kTriangleBytes;
}

engine::Result<ImportedMesh> readBinary(std::string_view bytes) {
    MeshBuilder mesh;
    const size_t count = (promisedBytes(bytes) - kHeaderBytes) / kTriangleBytes;
    for (size_t t = 0; t < count; ++t) {
        std::array<float, 9> numbers;
        std::memcpy(numbers.data(), bytes.data() + kHeaderBytes + t * kTriangleBytes + 12, sizeof numbers);
        std::array<Double3, 3> corners;
        for (size_t k = 0; k < 9; ++k) {
            if (!std::isfinite(numbers[k]))
                return badInput("triangle " + std::to_string(t) + " (byte " +
                                std::to_string(kHeaderBytes + t * kTriangleBytes) + "): " + kNotFinite);
            corners[k / 3][k % 3] = static_cast<double>(numbers[k]);
        }
        addTriangle(mesh, corners);
    }
    return mesh.take();
}

// nullopt where the three numbers are not there.
std::optional<Double3> readPoint(TextReader& text) {
    Double3 point;
    for (double& coordinate : point) {
        const auto number = parseNumber(text.nextWord());
        if (!number) return std::nullopt;
        coordinate = *number;
    }
    return point;
}

// "outer loop" and "endloop" carry no news; what counts is that every facet holds three vertices.
engine::Result<ImportedMesh> readText(std::string_view bytes) {
    TextReader text(bytes);
    text.nextLine();
    MeshBuilder mesh;
    std::array<Double3, 3> corners;
    size_t corner_count = 0;
    bool is_complete = false;
    for (std::string_view word = text.nextWord(); !word.empty(); word = text.nextWord()) {
        is_complete = word == "endsolid";
        if (is_complete || word == "solid") text.nextLine();
        if (word == "facet" && corner_count != 0)
            return badLine(text.line(), "a facet that does not end; export the file again");
        if (word == "vertex") {
            const auto point = readPoint(text);
            if (!point) return badLine(text.line(), "a vertex needs three numbers");
            if (corner_count == 3) return badLine(text.line(), "a facet has more than three vertices");
            for (const double coordinate : *point)
                if (!std::isfinite(coordinate)) return badLine(text.line(), kNotFinite);
            corners[corner_count++] = *point;
        }
        if (word == "endfacet") {
            if (corner_count != 3) return badLine(text.line(), "a facet has fewer than three vertices");
            addTriangle(mesh, corners);
            corner_count = 0;
        }
    }
    if (!is_complete) return badLine(text.line(), "ends without endsolid; the file was cut short, copy or export it again");
    return mesh.take();
}

} // namespace

// Binary files may begin with "solid" too: their length is what gives them away.
engine::Result<ImportedMesh> readStl(std::string_view bytes) {
    const bool is_binary = bytes.size() >= kHeaderBytes && promisedBytes(bytes) == bytes.size();
    const bool is_text = !is_binary && withoutMark(bytes).starts_with("solid") && !looksBinary(bytes);
    if (!is_binary && !is_text) {
        if (bytes.size() < kHeaderBytes) return badInput("too short for an STL file; copy or export it again");
        return badInput("its header promises " + std::to_string((promisedBytes(bytes) - kHeaderBytes) / kTriangleBytes) +
                        " triangles in " + std::to_string(promisedBytes(bytes)) + " bytes but it has " +
                        std::to_string(bytes.size()) + "; the file is damaged or not STL, copy or export it again");
    }
    auto mesh = is_binary ? readBinary(bytes) : readText(bytes);
    if (mesh && mesh->triangles.empty()) return badInput("no triangles in it; export the model again");
    return mesh;
}

} // namespace brittle
