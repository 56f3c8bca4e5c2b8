// Geomview's OFF with its prefixes: ST, C, N before OFF add texture coordinates, colors and normals to every vertex, 4 a
// weight by which the position is divided. The word OFF may be missing.
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
    const char* readMagic(std::string_view magic);
    std::optional<uint64_t> nextCount(Words& words);
    void skipEdgeCount(Words& words);
    engine::Result<void> readVertex(size_t number);
    engine::Result<void> readFace(size_t number);
    engine::Error cutShort(const char* what, size_t number, size_t count) const;
    engine::Error wrong(const std::string& message) const { return badLine(text_.line(), message); }

    TextReader text_;
    MeshBuilder mesh_;
    uint64_t vertex_count_ = 0, face_count_ = 0;
    bool has_normals_ = false, has_uvs_ = false, has_weights_ = false, has_dimension_ = false;
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
    ImportedMesh mesh = mesh_.take();
    if (!text_.nextFullLine().empty())
        mesh.notes.push_back("lines after the last face that the header counts are left out: from line " +
                             std::to_string(text_.line()));
    return mesh;
}

engine::Error OffReader::cutShort(const char* what, size_t number, size_t count) const {
    return badInput(std::string("ends at ") + what + " " + std::to_string(number) + " of " + std::to_string(count) +
                    " that its header promises; the file was cut short, copy or export it again");
}

// The letters stand in any order: programs do not agree on one.
const char* OffReader::readMagic(std::string_view magic) {
    if (magic == "off") return nullptr;
    if (!magic.ends_with("OFF")) return "an OFF file begins with the word OFF";
    magic.remove_suffix(3);
    while (!magic.empty()) {
        const size_t length = magic.starts_with("ST") ? 2 : 1;
        const std::string_view letter = magic.substr(0, length);
        has_uvs_ |= letter == "ST";
        has_normals_ |= letter == "N";
        has_weights_ |= letter == "4";
        has_dimension_ |= letter == "n";
        if (length == 1 && std::string_view("CN4n").find(letter) == letter.npos)
            return "OFF of this kind is not read; export a plain three-dimensional OFF";
        magic.remove_prefix(length);
    }
    return nullptr;
}

// On the same line or on the next.
std::optional<uint64_t> OffReader::nextCount(Words& words) {
    if (Words(words).next().empty()) words = Words(text_.nextFullLine());
    return words.nextInt<uint64_t>();
}

// The number of edges, if it has a line of its own: no vertex has a single number.
void OffReader::skipEdgeCount(Words& words) {
    if (!words.next().empty()) return;
    TextReader ahead = text_;
    Words next(ahead.nextFullLine());
    if (next.nextInt<uint64_t>() && next.next().empty()) text_ = ahead;
}

// Some collections write the first count right behind the magic word, as OFF216.
engine::Result<void> OffReader::readHeader() {
    const std::string_view line = text_.nextFullLine();
    Words words(line);
    const std::string_view first = Words(line).next();
    if (!Words(first).nextInt<uint64_t>()) {
        const size_t end = std::min(first.find_first_of("0123456789", first.find("OFF")), first.size());
        if (const char* bad = readMagic(first.substr(0, end))) return wrong(bad);
        words = Words(line.substr(static_cast<size_t>(first.data() - line.data()) + end));
    }
    if (has_dimension_ && nextCount(words) != uint64_t{3})
        return wrong("vertices of other than three dimensions; export a plain three-dimensional OFF");
    const auto vertices = nextCount(words);
    const auto faces = nextCount(words);
    if (!vertices || !faces) return wrong("the numbers of vertices and faces are missing");
    vertex_count_ = *vertices;
    face_count_ = *faces;
    skipEdgeCount(words);
    return {};
}

engine::Result<void> OffReader::readVertex(size_t number) {
    const std::string_view line = text_.nextFullLine();
    if (line.empty()) return cutShort("vertex", number, vertex_count_);
    Words words(line);
    std::vector<double> numbers;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        const auto value = parseNumber(word);
        if (!value) return wrong(hasComma(word) ? kDecimalComma : "a vertex holds something that is not a number");
        numbers.push_back(*value);
    }
    const size_t size = has_weights_ ? 4 : 3;
    if (numbers.size() < size) return wrong(has_weights_ ? "a vertex needs four numbers" : "a vertex needs three numbers");
    const double weight = has_weights_ ? numbers[3] : 1;
    const Double3 position = {numbers[0] / weight, numbers[1] / weight, numbers[2] / weight};
    if (!isFinite(position)) return wrong(kNotFinite);
    mesh_.addVertex(position);
    PolygonCorner& corner = attributes_.emplace_back();
    corner.position = static_cast<uint32_t>(number);
    if (has_normals_ && numbers.size() >= size + 3)
        corner.normal = toFloat({numbers[size], numbers[size + 1], numbers[size + 2]});
    if (has_uvs_ && numbers.size() >= size + 2)
        corner.uv = {static_cast<float>(numbers[numbers.size() - 2]), static_cast<float>(1 - numbers.back())};
    return {};
}

engine::Result<void> OffReader::readFace(size_t number) {
    const std::string_view line = text_.nextFullLine();
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
    Words first(TextReader(bytes).nextFullLine());
    if (first.next().ends_with("OFF") && first.next() == "BINARY")
        return badLine(1, "binary OFF is not read; export OFF as text, or PLY");
    const std::string_view text = withoutPadding(bytes);
    if (auto checked = checkIsText(text, "OFF"); !checked) return checked.error();
    return OffReader(text).run();
}

} // namespace brittle
