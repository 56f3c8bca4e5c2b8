// Geomview's OFF with its prefixes: ST, C, N before OFF add texture coordinates, colors and normals to every vertex.
#include "modules/brittle/mesh/readers.h"
#include "modules/brittle/mesh/text_reader.h"
#include "modules/brittle/mesh/vector_math.h"

#include <algorithm>

namespace brittle {
namespace {

class OffReader {
public:
    explicit OffReader(std::string_view bytes) : text_(bytes) {}
    engine::Result<ImportedMesh> run();

private:
    engine::Result<void> readHeader();
    engine::Result<void> readVertex(size_t number);
    engine::Result<void> readFace(size_t number);
    engine::Error cutShort(const char* what, size_t number, size_t count) const;
    engine::Error wrong(const std::string& message) const { return badLine(text_.line(), message); }

    TextReader text_;
    MeshBuilder mesh_;
    uint64_t vertex_count_ = 0, face_count_ = 0;
    bool has_normals_ = false, has_uvs_ = false;
    std::vector<PolygonCorner> attributes_; // of every vertex
    std::vector<PolygonCorner> corners_;
};

engine::Result<ImportedMesh> OffReader::run() {
    if (auto header = readHeader(); !header) return header.error();
    for (uint64_t v = 0; v < vertex_count_; ++v)
        if (auto vertex = readVertex(v); !vertex) return vertex.error();
    for (uint64_t f = 0; f < face_count_; ++f)
        if (auto face = readFace(f); !face) return face.error();
    if (mesh_.triangleCount() == 0) return badInput("no faces in it; export the model with its faces");
    return mesh_.take();
}

engine::Error OffReader::cutShort(const char* what, size_t number, size_t count) const {
    return badInput(std::string("ends at ") + what + " " + std::to_string(number) + " of " + std::to_string(count) +
                    " that its header promises; the file was cut short, copy or export it again");
}

// The counts may stand on the line of the magic word or on the next.
engine::Result<void> OffReader::readHeader() {
    std::string_view line = text_.nextFullLine('#');
    Words words(line);
    std::string_view magic = words.next();
    if (!magic.ends_with("OFF")) return wrong("an OFF file begins with the word OFF");
    magic.remove_suffix(3);
    has_uvs_ = magic.starts_with("ST");
    if (has_uvs_) magic.remove_prefix(2);
    if (magic.starts_with("C")) magic.remove_prefix(1);
    has_normals_ = magic.starts_with("N");
    if (has_normals_) magic.remove_prefix(1);
    if (!magic.empty()) return wrong("OFF of this kind is not read; export a plain three-dimensional OFF");
    std::string_view first = words.next();
    if (first.empty()) {
        words = Words(text_.nextFullLine('#'));
        first = words.next();
    }
    if (first == "BINARY") return wrong("binary OFF is not read; export OFF as text");
    const auto vertices = Words(first).nextInt<uint64_t>();
    const auto faces = words.nextInt<uint64_t>();
    if (!vertices || !faces) return wrong("the numbers of vertices and faces are missing");
    vertex_count_ = *vertices;
    face_count_ = *faces;
    return {};
}

engine::Result<void> OffReader::readVertex(size_t number) {
    const std::string_view line = text_.nextFullLine('#');
    if (line.empty()) return cutShort("vertex", number, vertex_count_);
    Words words(line);
    std::vector<double> numbers;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        const auto value = parseNumber(word);
        if (!value) return wrong("a vertex holds something that is not a number");
        numbers.push_back(*value);
    }
    if (numbers.size() < 3) return wrong("a vertex needs three numbers");
    const Double3 position = {numbers[0], numbers[1], numbers[2]};
    if (!isFinite(position)) return wrong(kNotFinite);
    mesh_.addVertex(position);
    PolygonCorner& corner = attributes_.emplace_back();
    corner.position = static_cast<uint32_t>(number);
    if (has_normals_ && numbers.size() >= 6) corner.normal = toFloat({numbers[3], numbers[4], numbers[5]});
    if (has_uvs_ && numbers.size() >= 5)
        corner.uv = {static_cast<float>(numbers[numbers.size() - 2]), static_cast<float>(1 - numbers.back())};
    return {};
}

engine::Result<void> OffReader::readFace(size_t number) {
    const std::string_view line = text_.nextFullLine('#');
    if (line.empty()) return cutShort("face", number, face_count_);
    Words words(line); // what follows the indices is a color
    const auto count = words.nextInt<uint32_t>();
    if (!count) return wrong("a face begins with its number of corners");
    corners_.clear();
    for (uint32_t k = 0; k < *count; ++k) {
        const std::string_view word = words.next();
        if (word.empty() && text_.atEnd()) return cutShort("face", number, face_count_);
        if (word.empty()) return wrong("a face has fewer corners than it says");
        const auto index = Words(word).nextInt<uint64_t>();
        if (!index) return wrong("a face holds something that is not a vertex number");
        if (*index >= attributes_.size())
            return wrong("a face refers to vertex " + std::to_string(*index) + " of " + std::to_string(vertex_count_) +
                         ", counted from 0; the file is damaged, export it again");
        corners_.push_back(attributes_[*index]);
    }
    if (const char* bad = mesh_.addPolygon(corners_)) return wrong(bad);
    return {};
}

} // namespace

engine::Result<ImportedMesh> readOff(std::string_view bytes) {
    if (looksBinary(bytes))
        return badInput("binary data where OFF text was expected; give the file the ending of its real format");
    return OffReader(bytes).run();
}

} // namespace brittle
