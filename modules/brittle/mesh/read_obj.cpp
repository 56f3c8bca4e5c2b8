// Wavefront OBJ: v, vt, vn and f. Groups and materials are skipped; lines, points, curves and surfaces are left out with a
// note. A face may stand before its vertices: then it is read at the end.
#include "modules/brittle/mesh/readers.h"
#include "modules/brittle/mesh/text_reader.h"

#include <algorithm>
#include <deque>

namespace brittle {
namespace {

struct Statement {
    std::string_view text;
    size_t line = 0;
    bool is_joined = false; // of several lines; its text lives until the next such statement
};

// Indices of position, texture coordinate and normal, as the file has them: from 1, or negative.
using CornerIndices = std::array<int64_t, 3>;
constexpr int64_t kAbsent = INT64_MIN, kBeyondAll = INT64_MAX;

class ObjReader {
public:
    explicit ObjReader(std::string_view bytes) : text_(bytes) {}
    engine::Result<ImportedMesh> run();

private:
    // nullptr where all is well, else what is wrong with the line.
    const char* readLine(const Statement& statement);
    const char* readVertex(Words& words);
    const char* readNormal(Words& words);
    const char* readTextureCoordinate(Words& words);
    const char* readFace(Words words, const Statement& statement);
    const char* findCorner(const CornerIndices& indices, PolygonCorner& corner, size_t line);
    bool hasToWait() const;
    void noteUnread(std::string_view kind, size_t line);
    Statement nextStatement();
    engine::Error refusal(size_t line, const char* wrong) const;
    engine::Error withoutFaces() const;
    void writeNotes(ImportedMesh& mesh) const;

    TextReader text_;
    std::string joined_;             // a statement of several lines
    std::vector<Statement> waiting_; // faces before their vertices
    std::deque<std::string> kept_;   // texts of waiting faces of several lines
    bool is_at_end_ = false;
    MeshBuilder mesh_;
    std::vector<Float3> normals_;
    std::vector<Float2> uvs_;
    std::vector<CornerIndices> indices_; // of the current face
    std::vector<PolygonCorner> corners_; // of the current face
    LeftOut lost_normals_, lost_uvs_, small_faces_, lines_, points_, curves_, unknown_;
};

engine::Result<ImportedMesh> ObjReader::run() {
    while (!text_.atEnd()) {
        const Statement statement = nextStatement();
        if (const char* wrong = readLine(statement)) return refusal(statement.line, wrong);
    }
    is_at_end_ = true;
    for (const Statement& statement : waiting_)
        if (const char* wrong = readLine(statement)) return refusal(statement.line, wrong);
    if (mesh_.triangleCount() == 0) return withoutFaces();
    ImportedMesh mesh = mesh_.take();
    writeNotes(mesh);
    return mesh;
}

// Lines that were left out may be the reason.
engine::Error ObjReader::refusal(size_t line, const char* wrong) const {
    const bool is_all_obj = unknown_.count() == 0;
    return badLine(line, wrong + (is_all_obj ? "" : "; lines that are not OBJ are left out: " + unknown_.described("line")));
}

engine::Error ObjReader::withoutFaces() const {
    if (curves_.count() > 0)
        return badInput(curves_.described("statement") + " of curves and surfaces but no faces; export the model as polygons");
    if (mesh_.vertexCount() == 0) return badInput("no vertices in it; is it really an OBJ file?");
    const std::string vertices = std::to_string(mesh_.vertexCount()) + " vertices ";
    if (lines_.count() + points_.count() > 0)
        return badInput(vertices + "with lines or points but no faces; export the model with its faces");
    return badInput(vertices + "but no faces; export the model with its faces");
}

void ObjReader::writeNotes(ImportedMesh& mesh) const {
    const auto write = [&](const char* sentence, const LeftOut& left_out, const char* noun) {
        if (left_out.count() > 0) mesh.notes.push_back(sentence + left_out.described(noun));
    };
    write("normals that are not in the file are left out: ", lost_normals_, "corner");
    write("texture coordinates that are not in the file are left out: ", lost_uvs_, "corner");
    write("faces of fewer than three corners are left out: ", small_faces_, "face");
    write("lines are left out: ", lines_, "statement");
    write("points are left out: ", points_, "statement");
    write("curves and surfaces are left out, export them as polygons: ", curves_, "statement");
    write("lines that are not OBJ are left out: ", unknown_, "line");
}

// Names may end with a backslash, as folders do; only numbers go on in the next line.
bool mayContinue(std::string_view line) {
    const std::string_view kind = Words(line).next();
    if (kind.starts_with('#')) return false;
    static constexpr std::string_view kNames[] = {"g", "o", "s", "mtllib", "usemtl", "maplib", "usemap", "mg"};
    return std::find(std::begin(kNames), std::end(kNames), kind) == std::end(kNames);
}

std::string_view withoutBlanksBehind(std::string_view line) {
    while (!line.empty() && isBlank(line.back()))
        line.remove_suffix(1);
    return line;
}

// A backslash at the end of a line goes on with the next.
Statement ObjReader::nextStatement() {
    std::string_view line = withoutBlanksBehind(text_.nextLine());
    const size_t first = text_.line();
    if (!line.ends_with('\\') || !mayContinue(line)) return {line, first};
    joined_.clear();
    while (line.ends_with('\\')) {
        joined_ += line.substr(0, line.size() - 1);
        joined_ += ' ';
        line = withoutBlanksBehind(text_.nextLine());
    }
    joined_ += line;
    return {joined_, first, true};
}

const char* ObjReader::readLine(const Statement& statement) {
    Words words(withoutComment(statement.text));
    const std::string_view kind = words.next();
    if (kind == "v") return readVertex(words);
    if (kind == "f" || kind == "fo") return readFace(words, statement);
    if (kind == "vn") return readNormal(words);
    if (kind == "vt") return readTextureCoordinate(words);
    noteUnread(kind, statement.line);
    return nullptr;
}

void ObjReader::noteUnread(std::string_view kind, size_t line) {
    static constexpr std::string_view kQuiet[] = {
        "",          "g",        "o",        "s",          "usemtl", "mtllib", "usemap", "maplib", "mg",    "lod",
        "bevel",     "c_interp", "d_interp", "shadow_obj", "vp",     "cstype", "deg",    "bmat",   "step",  "parm",
        "trace_obj", "trim",     "hole",     "scrv",       "sp",     "end",    "con",    "ctech",  "stech", "vc"};
    static constexpr std::string_view kShapes[] = {"curv", "curv2", "surf", "bsp", "bzp", "cdc", "cdp", "res"};
    const auto isAmong = [&](auto& names) { return std::find(std::begin(names), std::end(names), kind) != std::end(names); };
    if (isAmong(kQuiet)) return;
    if (kind == "l")
        lines_.add(line);
    else if (kind == "p")
        points_.add(line);
    else
        (isAmong(kShapes) ? curves_ : unknown_).add(line);
}

// Colors or a weight may follow the position; words may not, because they hint at a line end that is lost.
const char* ObjReader::readVertex(Words& words) {
    Double3 position;
    for (double& coordinate : position) {
        const std::string_view word = words.next();
        const std::optional<double> number = parseNumber(word);
        if (!number) return hasComma(word) ? kDecimalComma : "a vertex needs three numbers";
        if (!std::isfinite(*number)) return kNotFinite;
        coordinate = *number;
    }
    for (std::string_view word = words.next(); !word.empty(); word = words.next())
        if (!parseNumber(word)) return "a vertex is followed by something that is not a number; export the file again";
    mesh_.addVertex(position);
    return nullptr;
}

const char* ObjReader::readNormal(Words& words) {
    for (float& coordinate : normals_.emplace_back()) {
        const std::string_view word = words.next();
        const std::optional<double> number = parseNumber(word);
        if (!number) return hasComma(word) ? kDecimalComma : "a normal needs three numbers";
        coordinate = static_cast<float>(*number);
    }
    return nullptr;
}

const char* ObjReader::readTextureCoordinate(Words& words) {
    const std::string_view word = words.next();
    const std::optional<double> u = parseNumber(word);
    if (!u) return hasComma(word) ? kDecimalComma : "a texture coordinate needs a number";
    const double v = words.nextNumber().value_or(0);
    uvs_.push_back({static_cast<float>(*u), static_cast<float>(1 - v)}); // v points up in the file
    return nullptr;
}

constexpr const char* kNoIndex = "a face holds something that is not an index; export the file again";

// position, position/uv, position//normal or position/uv/normal.
const char* parseCorner(std::string_view word, CornerIndices& indices) {
    indices.fill(kAbsent);
    size_t at = 0;
    for (size_t k = 0; k < 3 && at <= word.size(); ++k, ++at) {
        if (at < word.size() && word[at] != '/') {
            const char* const begin = word.data() + at;
            const auto [end, error] = std::from_chars(begin, word.data() + word.size(), indices[k]);
            if (end == begin) return kNoIndex;
            if (error == std::errc::result_out_of_range || indices[k] == kAbsent) indices[k] = kBeyondAll;
            at += static_cast<size_t>(end - begin);
        }
        if (at < word.size() && word[at] != '/') return kNoIndex;
    }
    return at <= word.size() || indices[0] == kAbsent ? kNoIndex : nullptr;
}

// Counts from 1, or backward from the last one read. nullopt if it is outside.
std::optional<uint32_t> resolve(int64_t index, size_t count) {
    index += index < 0 ? static_cast<int64_t>(count) : -1;
    if (index < 0 || index >= static_cast<int64_t>(count)) return std::nullopt;
    return static_cast<uint32_t>(index);
}

// Finds out if an index is larger than the counts so far. A negative index cannot wait: it counts from here.
bool ObjReader::hasToWait() const {
    const std::array<size_t, 3> counts = {mesh_.vertexCount(), uvs_.size(), normals_.size()};
    bool is_ahead = false;
    for (const CornerIndices& indices : indices_)
        for (size_t k = 0; k < 3; ++k) {
            if (indices[k] < 0 && indices[k] != kAbsent) return false;
            is_ahead |= indices[k] > static_cast<int64_t>(counts[k]);
        }
    return is_ahead;
}

const char* ObjReader::readFace(Words words, const Statement& statement) {
    indices_.clear();
    for (std::string_view word = words.next(); !word.empty(); word = words.next())
        if (const char* wrong = parseCorner(word, indices_.emplace_back())) return wrong;
    if (!is_at_end_ && hasToWait()) {
        const std::string_view text = statement.is_joined ? kept_.emplace_back(statement.text) : statement.text;
        waiting_.push_back({text, statement.line});
        return nullptr;
    }
    corners_.clear();
    for (const CornerIndices& indices : indices_)
        if (const char* wrong = findCorner(indices, corners_.emplace_back(), statement.line)) return wrong;
    if (corners_.size() >= 3) return mesh_.addPolygon(corners_);
    small_faces_.add(statement.line);
    return nullptr;
}

// The shape needs no normals or texture coordinates: if an index leads nowhere, they are left out.
const char* ObjReader::findCorner(const CornerIndices& indices, PolygonCorner& corner, size_t line) {
    const auto position = resolve(indices[0], mesh_.vertexCount());
    if (!position) return "a face refers to a vertex that is not there; the file is damaged, export it again";
    corner.position = *position;
    if (indices[1] != kAbsent) {
        const auto uv = resolve(indices[1], uvs_.size());
        if (uv) corner.uv = uvs_[*uv];
        if (!uv) lost_uvs_.add(line);
    }
    if (indices[2] != kAbsent) {
        const auto normal = resolve(indices[2], normals_.size());
        if (normal) corner.normal = normals_[*normal];
        if (!normal) lost_normals_.add(line);
    }
    return nullptr;
}

} // namespace

engine::Result<ImportedMesh> readObj(std::string_view bytes) {
    const std::string_view text = withoutPadding(bytes);
    if (auto checked = checkIsText(text, "OBJ"); !checked) return checked.error();
    return ObjReader(text).run();
}

} // namespace brittle
