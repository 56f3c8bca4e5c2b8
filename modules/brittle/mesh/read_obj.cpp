// Wavefront OBJ: v, vt, vn and f. Groups, materials, lines, points and curves are skipped.
#include "modules/brittle/mesh/readers.h"
#include "modules/brittle/mesh/text_reader.h"

namespace brittle {

engine::Error badInput(std::string message) { return {engine::ErrorCode::BadInput, std::move(message)}; }

engine::Error badLine(size_t line, const std::string& message) {
    return badInput("line " + std::to_string(line) + ": " + message);
}

bool looksBinary(std::string_view bytes) { return bytes.find('\0') != bytes.npos; }

namespace {

class ObjReader {
public:
    explicit ObjReader(std::string_view bytes) : text_(bytes) {}
    engine::Result<ImportedMesh> run();

private:
    // nullptr where all is well, else what is wrong with the line.
    const char* readLine(std::string_view line);
    const char* readVertex(Words& words);
    const char* readFace(Words& words);
    const char* readCorner(std::string_view word, PolygonCorner& corner) const;
    std::string_view nextStatement();

    TextReader text_;
    std::string continued_; // a statement over several lines
    size_t first_line_ = 0;
    MeshBuilder mesh_;
    std::vector<Float3> normals_;
    std::vector<Float2> uvs_;
    std::vector<PolygonCorner> corners_;
};

engine::Result<ImportedMesh> ObjReader::run() {
    while (!text_.atEnd())
        if (const char* wrong = readLine(nextStatement())) return badLine(first_line_, wrong);
    if (mesh_.vertexCount() == 0) return badInput("no vertices in it; is it really an OBJ file?");
    if (mesh_.triangleCount() == 0)
        return badInput(std::to_string(mesh_.vertexCount()) + " vertices but no faces; export the model with its faces");
    return mesh_.take();
}

// A backslash at the end of a line goes on with the next.
std::string_view ObjReader::nextStatement() {
    std::string_view line = text_.nextLine();
    first_line_ = text_.line();
    if (!line.ends_with('\\')) return line;
    continued_.clear();
    while (line.ends_with('\\')) {
        continued_ += line.substr(0, line.size() - 1);
        continued_ += ' ';
        line = text_.nextLine();
    }
    return continued_ += line;
}

template <size_t N>
bool readNumbers(Words& words, std::array<float, N>& numbers) {
    for (float& number : numbers) {
        const std::optional<double> value = words.nextNumber();
        if (!value) return false;
        number = static_cast<float>(*value);
    }
    return true;
}

const char* ObjReader::readLine(std::string_view line) {
    Words words(line.substr(0, line.find('#')));
    const std::string_view kind = words.next();
    if (kind == "v") return readVertex(words);
    if (kind == "f") return readFace(words);
    if (kind == "vn") {
        if (!readNumbers(words, normals_.emplace_back())) return "a normal needs three numbers";
    } else if (kind == "vt") {
        Float2& uv = uvs_.emplace_back(Float2{0, 0});
        const std::optional<double> u = words.nextNumber();
        if (!u) return "a texture coordinate needs a number";
        uv = {static_cast<float>(*u), static_cast<float>(1 - words.nextNumber().value_or(0))}; // v points up in the file
    }
    return nullptr;
}

const char* ObjReader::readVertex(Words& words) {
    Double3 position;
    for (double& coordinate : position) {
        const std::optional<double> number = words.nextNumber();
        if (!number) return "a vertex needs three numbers";
        if (!std::isfinite(*number)) return kNotFinite;
        coordinate = *number;
    }
    mesh_.addVertex(position);
    return nullptr;
}

const char* ObjReader::readFace(Words& words) {
    corners_.clear();
    for (std::string_view word = words.next(); !word.empty(); word = words.next())
        if (const char* wrong = readCorner(word, corners_.emplace_back())) return wrong;
    if (corners_.size() < 3) return "a face needs three corners";
    return mesh_.addPolygon(corners_);
}

// Counts from 1, or backward from what was read last. nullopt where it is outside.
std::optional<uint32_t> resolve(std::string_view word, size_t count) {
    int64_t index = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    index += index < 0 ? static_cast<int64_t>(count) : -1;
    if (index < 0 || index >= static_cast<int64_t>(count)) return std::nullopt;
    return static_cast<uint32_t>(index);
}

// position, position/uv, position//normal or position/uv/normal.
const char* ObjReader::readCorner(std::string_view word, PolygonCorner& corner) const {
    std::array<std::string_view, 3> parts;
    for (std::string_view& part : parts) {
        const size_t slash = word.find('/');
        part = word.substr(0, slash);
        word = slash == word.npos ? std::string_view() : word.substr(slash + 1);
    }
    const auto position = resolve(parts[0], mesh_.vertexCount());
    if (!position) return "a face refers to a vertex that is not there; the file is damaged, export it again";
    corner.position = *position;
    if (!parts[1].empty()) {
        const auto uv = resolve(parts[1], uvs_.size());
        if (!uv) return "a face refers to a texture coordinate that is not there; the file is damaged, export it again";
        corner.uv = uvs_[*uv];
    }
    if (!parts[2].empty()) {
        const auto normal = resolve(parts[2], normals_.size());
        if (!normal) return "a face refers to a normal that is not there; the file is damaged, export it again";
        corner.normal = normals_[*normal];
    }
    return nullptr;
}

} // namespace

engine::Result<ImportedMesh> readObj(std::string_view bytes) {
    if (looksBinary(bytes))
        return badInput("binary data where OBJ text was expected; give the file the ending of its real format");
    return ObjReader(bytes).run();
}

} // namespace brittle
