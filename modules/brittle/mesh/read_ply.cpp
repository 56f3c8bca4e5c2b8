// Stanford PLY, text and binary of either byte order. Its elements `vertex` and `face` are read, and `tristrips` where there
// are no faces; others are left out with a note.
#include "modules/brittle/mesh/readers.h"
#include "modules/brittle/mesh/text_reader.h"
#include "modules/brittle/mesh/vector_math.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace brittle {
namespace {

enum class Format { Text, LittleEndian, BigEndian };

enum class Number { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float, Double };

std::optional<Number> numberType(std::string_view name) {
    static constexpr std::pair<std::string_view, Number> kNames[] = {
        {"char", Number::Int8},   {"uchar", Number::Uint8},   {"short", Number::Int16},   {"ushort", Number::Uint16},
        {"int", Number::Int32},   {"uint", Number::Uint32},   {"float", Number::Float},   {"double", Number::Double},
        {"int8", Number::Int8},   {"uint8", Number::Uint8},   {"int16", Number::Int16},   {"uint16", Number::Uint16},
        {"int32", Number::Int32}, {"uint32", Number::Uint32}, {"float32", Number::Float}, {"float64", Number::Double},
    };
    for (const auto& [known, type] : kNames)
        if (known == name) return type;
    return std::nullopt;
}

struct Property {
    std::string name;
    Number type = Number::Float;
    std::optional<Number> count_type; // of lists only
};

struct Element {
    std::string name;
    uint64_t count = 0;
    std::vector<Property> properties;
};

// Reads numbers of the given types one after the other, from text or bytes. nullopt at the end of the data and where the text
// holds no number.
class NumberStream {
public:
    NumberStream(std::string_view data, Format format, size_t lines_before)
        : text_(data, lines_before), bytes_(data), format_(format) {}
    std::optional<double> next(Number type);
    size_t bytesLeft() const { return format_ == Format::Text ? text_.rest().size() : bytes_.size(); }
    bool holdsMore() const; // than blanks
    // "line 12: " of text, nothing of binary data.
    std::string place() const { return format_ == Format::Text ? "line " + std::to_string(text_.line()) + ": " : ""; }
    bool stoppedAtComma() const { return stopped_at_comma_; }

private:
    template <class T>
    std::optional<double> nextBinary();

    TextReader text_;
    std::string_view bytes_;
    Format format_;
    bool stopped_at_comma_ = false;
};

bool NumberStream::holdsMore() const {
    const std::string_view rest = format_ == Format::Text ? text_.rest() : bytes_;
    return !std::all_of(rest.begin(), rest.end(), isBlank);
}

template <class T>
std::optional<double> NumberStream::nextBinary() {
    if (bytes_.size() < sizeof(T)) return std::nullopt;
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes_.data(), sizeof(T));
    bytes_.remove_prefix(sizeof(T));
    if ((format_ == Format::BigEndian) != (std::endian::native == std::endian::big)) std::reverse(raw.begin(), raw.end());
    return static_cast<double>(std::bit_cast<T>(raw));
}

std::optional<double> NumberStream::next(Number type) {
    if (format_ == Format::Text) {
        std::string_view word = text_.nextWord();
        for (; word == "comment"; word = text_.nextWord())
            text_.nextLine();
        const auto number = parseNumber(word);
        stopped_at_comma_ = !number && hasComma(word);
        return number;
    }
    switch (type) {
    case Number::Int8: return nextBinary<int8_t>();
    case Number::Uint8: return nextBinary<uint8_t>();
    case Number::Int16: return nextBinary<int16_t>();
    case Number::Uint16: return nextBinary<uint16_t>();
    case Number::Int32: return nextBinary<int32_t>();
    case Number::Uint32: return nextBinary<uint32_t>();
    case Number::Float: return nextBinary<float>();
    case Number::Double: return nextBinary<double>();
    }
    return std::nullopt;
}

class PlyReader {
public:
    explicit PlyReader(std::string_view bytes) : bytes_(bytes) {}
    engine::Result<ImportedMesh> run();

private:
    engine::Result<NumberStream> readHeader();
    const char* readHeaderLine(Words words, Format& format);
    const char* readProperty(Words& words);
    engine::Result<void> readElement(const Element& element, NumberStream& stream);
    const char* readRow(const Element& element, NumberStream& stream);
    const char* readProperty(const Property& property, NumberStream& stream);
    const char* finishVertex();
    const char* finishFace();
    const char* finishStrips();
    const char* findCorner(double index, PolygonCorner& corner) const;
    engine::Result<void> checkElements() const;
    const Element* find(std::string_view name) const;
    bool hasRows(std::string_view name) const { return find(name) && find(name)->count > 0; }
    void writeNotes(const NumberStream& stream, std::vector<std::string>& notes) const;
    double value(std::string_view name, double otherwise) const;
    double valueOfAny(std::initializer_list<std::string_view> names, double otherwise) const;

    std::string_view bytes_;
    std::vector<Element> elements_;
    MeshBuilder mesh_;
    std::vector<PolygonCorner> attributes_;                   // of every vertex
    std::vector<std::pair<std::string_view, double>> values_; // of the current row, lists left out
    std::vector<double> list_, indices_, uvs_;                // of the current row
    std::vector<PolygonCorner> corners_;
};

engine::Result<ImportedMesh> PlyReader::run() {
    auto stream = readHeader();
    if (!stream) return stream.error();
    if (auto known = checkElements(); !known) return known.error();
    for (const Element& element : elements_)
        if (auto read = readElement(element, *stream); !read) return read.error();
    const size_t points = mesh_.vertexCount();
    if (mesh_.triangleCount() == 0 && points > 0)
        return badInput("no faces but " + std::to_string(points) +
                        " points in it; make a surface of them and export its faces");
    if (mesh_.triangleCount() == 0) return badInput("no faces in it; export the model with its faces");
    ImportedMesh mesh = mesh_.take();
    writeNotes(*stream, mesh.notes);
    return mesh;
}

const Element* PlyReader::find(std::string_view name) const {
    const auto found = std::find_if(elements_.begin(), elements_.end(), [&](const Element& e) { return e.name == name; });
    return found == elements_.end() ? nullptr : &*found;
}

bool isIndexList(const Property& property) {
    return property.count_type && (property.name == "vertex_indices" || property.name == "vertex_index");
}

// Faults of the header as a whole.
engine::Result<void> PlyReader::checkElements() const {
    const Element* vertices = find("vertex");
    for (const char* axis : {"x", "y", "z"})
        if (vertices && std::none_of(vertices->properties.begin(), vertices->properties.end(),
                                     [&](const Property& property) { return property.name == axis && !property.count_type; }))
            return badInput(std::string("element vertex has no property ") + axis + "; export the model again");
    if (hasRows("vertex") && !hasRows("face") && !hasRows("tristrips"))
        return badInput("no faces but " + std::to_string(vertices->count) +
                        " points in it; make a surface of them and export its faces");
    for (const char* name : {"face", "tristrips"}) {
        if (!hasRows(name)) continue;
        const Element* faces = find(name);
        if (std::none_of(faces->properties.begin(), faces->properties.end(), isIndexList))
            return badInput(std::string("element ") + name + " has no list vertex_indices; export the model with its faces");
        if (!vertices || vertices > faces)
            return badInput(std::string("element ") + name + " stands before element vertex; write the vertices first");
    }
    return {};
}

void PlyReader::writeNotes(const NumberStream& stream, std::vector<std::string>& notes) const {
    const auto others = std::count_if(elements_.begin(), elements_.end(), [](const Element& e) {
        return e.count > 0 && e.name != "vertex" && e.name != "face" && e.name != "tristrips";
    });
    if (others > 0) notes.push_back("elements that are neither vertices nor faces are left out: " + std::to_string(others));
    if (hasRows("face") && hasRows("tristrips"))
        notes.push_back("triangle strips are left out, because the file has faces too");
    if (stream.holdsMore()) notes.push_back(std::to_string(stream.bytesLeft()) + " bytes after the last element are left out");
}

engine::Result<NumberStream> PlyReader::readHeader() {
    TextReader text(bytes_);
    if (!isWord(Words(text.nextLine()).next(), "ply")) return badLine(1, "a PLY file begins with the word ply");
    Format format = Format::Text;
    while (true) {
        if (text.atEnd()) return badLine(text.line(), "the header does not end; copy or export the file again");
        const Words words(text.nextLine());
        if (Words(words).next() == "end_header") return NumberStream(text.rest(), format, text.line());
        if (const char* wrong = readHeaderLine(words, format)) return badLine(text.line(), wrong);
    }
}

const char* PlyReader::readHeaderLine(Words words, Format& format) {
    const std::string_view kind = words.next();
    if (kind == "format") {
        const std::string_view name = words.next();
        if (name == "binary_little_endian")
            format = Format::LittleEndian;
        else if (name == "binary_big_endian")
            format = Format::BigEndian;
        else if (name != "ascii")
            return "a PLY format that is not known; use ascii, binary_little_endian or binary_big_endian";
    } else if (kind == "element") {
        Element& element = elements_.emplace_back();
        element.name = words.next();
        const auto count = words.nextInt<uint64_t>();
        if (!count) return "an element without a count";
        element.count = *count;
    } else if (kind == "property") {
        return readProperty(words);
    } else if (kind != "comment" && kind != "obj_info" && !kind.empty() && !elements_.empty()) {
        // Before the first element, Blender 2.4 wrote a line about itself.
        return "a header line that is not PLY";
    }
    return nullptr;
}

const char* PlyReader::readProperty(Words& words) {
    if (elements_.empty()) return "a property before any element";
    Property property;
    std::string_view type = words.next();
    if (type == "list") {
        property.count_type = numberType(words.next());
        if (!property.count_type) return "a list whose count has no known type";
        type = words.next();
    }
    const auto known = numberType(type);
    if (!known) return "a property of a type that is not known; use char, short, int, float or double";
    property.type = *known;
    property.name = words.next();
    elements_.back().properties.push_back(std::move(property));
    return nullptr;
}

engine::Result<void> PlyReader::readElement(const Element& element, NumberStream& stream) {
    if (element.properties.empty()) return {}; // no bytes, whatever the count
    for (uint64_t row = 0; row < element.count; ++row)
        if (const char* wrong = readRow(element, stream))
            return badInput(stream.place() + element.name + " " + std::to_string(row) + " of " + std::to_string(element.count) +
                            ": " + (stream.stoppedAtComma() ? kDecimalComma : wrong));
    return {};
}

const char* PlyReader::readRow(const Element& element, NumberStream& stream) {
    values_.clear();
    indices_.clear();
    uvs_.clear();
    for (const Property& property : element.properties)
        if (const char* wrong = readProperty(property, stream)) return wrong;
    if (element.name == "vertex") return finishVertex();
    if (element.name == "face") return finishFace();
    return element.name == "tristrips" && !hasRows("face") ? finishStrips() : nullptr;
}

const char* PlyReader::readProperty(const Property& property, NumberStream& stream) {
    static constexpr const char* kCutShort = "no number where one was expected; the file is damaged, copy or export it again";
    if (!property.count_type) {
        const auto number = stream.next(property.type);
        if (!number) return kCutShort;
        values_.emplace_back(property.name, *number);
        return nullptr;
    }
    const auto count = stream.next(*property.count_type);
    if (!count) return kCutShort;
    // Every entry takes a byte at least, which keeps a damaged count from being believed.
    if (*count != std::floor(*count)) return "a list whose length is no whole number; the file is damaged, export it again";
    if (!(*count >= 0 && *count <= static_cast<double>(stream.bytesLeft()))) return "a list that is longer than the file";
    list_.clear();
    for (auto left = static_cast<uint64_t>(*count); left > 0; --left) {
        const auto number = stream.next(property.type);
        if (!number) return kCutShort;
        list_.push_back(*number);
    }
    if (isIndexList(property)) indices_ = list_;
    if (property.name == "texcoord") uvs_ = list_;
    return nullptr;
}

double PlyReader::value(std::string_view name, double otherwise) const {
    const auto found = std::find_if(values_.begin(), values_.end(), [&](const auto& entry) { return entry.first == name; });
    return found == values_.end() ? otherwise : found->second;
}

double PlyReader::valueOfAny(std::initializer_list<std::string_view> names, double otherwise) const {
    for (const std::string_view name : names)
        if (const double found = value(name, HUGE_VAL); found != HUGE_VAL) return found;
    return otherwise;
}

const char* PlyReader::finishVertex() {
    const double missing = std::nan("");
    const Double3 position = {value("x", missing), value("y", missing), value("z", missing)};
    if (!isFinite(position)) return kNotFinite;
    PolygonCorner& corner = attributes_.emplace_back();
    corner.position = static_cast<uint32_t>(mesh_.vertexCount());
    corner.normal = toFloat({value("nx", 0), value("ny", 0), value("nz", 0)});
    corner.uv = {static_cast<float>(valueOfAny({"u", "s", "texture_u"}, 0)),
                 static_cast<float>(1 - valueOfAny({"v", "t", "texture_v"}, 1))}; // v points up in the file
    mesh_.addVertex(position);
    return nullptr;
}

const char* PlyReader::findCorner(double index, PolygonCorner& corner) const {
    if (!(index == std::floor(index) && index >= 0 && index < static_cast<double>(attributes_.size())))
        return "it refers to a vertex that is not there; the file is damaged, export it again";
    corner = attributes_[static_cast<size_t>(index)];
    return nullptr;
}

const char* PlyReader::finishFace() {
    corners_.clear();
    for (size_t k = 0; k < indices_.size(); ++k) {
        if (const char* wrong = findCorner(indices_[k], corners_.emplace_back())) return wrong;
        if (uvs_.size() == 2 * indices_.size())
            corners_.back().uv = {static_cast<float>(uvs_[2 * k]), static_cast<float>(1 - uvs_[2 * k + 1])};
    }
    return mesh_.addPolygon(corners_);
}

// An index of -1 ends a strip. Every second triangle of a strip runs the other way.
const char* PlyReader::finishStrips() {
    corners_.clear();
    for (const double index : indices_) {
        if (index == -1) {
            corners_.clear();
            continue;
        }
        if (const char* wrong = findCorner(index, corners_.emplace_back())) return wrong;
        const size_t length = corners_.size();
        if (length < 3) continue;
        std::array<PolygonCorner, 3> triangle = {corners_[length - 3], corners_[length - 2], corners_[length - 1]};
        if (length % 2 == 0) std::swap(triangle[0], triangle[1]);
        if (const char* wrong = mesh_.addPolygon(triangle)) return wrong;
    }
    return nullptr;
}

} // namespace

engine::Result<ImportedMesh> readPly(std::string_view bytes) {
    if (isUtf16(bytes)) return badInput(kUtf16);
    return PlyReader(bytes).run();
}

} // namespace brittle
