// Stanford PLY, text and binary of either byte order. Of its elements `vertex` and `face` are read, the others skipped.
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
    NumberStream(std::string_view data, Format format) : text_(data), bytes_(data), format_(format) {}
    std::optional<double> next(Number type);
    size_t bytesLeft() const { return format_ == Format::Text ? text_.rest().size() : bytes_.size(); }

private:
    template <class T>
    std::optional<double> nextBinary();

    TextReader text_;
    std::string_view bytes_;
    Format format_;
};

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
    if (format_ == Format::Text) return parseNumber(text_.nextWord());
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
    for (const Element& element : elements_)
        if (auto read = readElement(element, *stream); !read) return read.error();
    if (mesh_.triangleCount() == 0) return badInput("no faces in it; export the model with its faces");
    return mesh_.take();
}

engine::Result<NumberStream> PlyReader::readHeader() {
    TextReader text(bytes_);
    if (Words(text.nextLine()).next() != "ply") return badLine(1, "a PLY file begins with the word ply");
    Format format = Format::Text;
    while (true) {
        if (text.atEnd()) return badLine(text.line(), "the header does not end; copy or export the file again");
        const Words words(text.nextLine());
        if (Words(words).next() == "end_header") return NumberStream(text.rest(), format);
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
            return "a PLY format that is not known";
    } else if (kind == "element") {
        Element& element = elements_.emplace_back();
        element.name = words.next();
        const auto count = words.nextInt<uint64_t>();
        if (!count) return "an element without a count";
        element.count = *count;
    } else if (kind == "property") {
        return readProperty(words);
    } else if (kind != "comment" && kind != "obj_info" && !kind.empty()) {
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
    if (!known) return "a property of a type that is not known";
    property.type = *known;
    property.name = words.next();
    elements_.back().properties.push_back(std::move(property));
    return nullptr;
}

engine::Result<void> PlyReader::readElement(const Element& element, NumberStream& stream) {
    if (element.name == "tristrips") return badInput("triangle strips are not read; export plain faces");
    if (element.properties.empty()) return {}; // no bytes, whatever the count
    for (uint64_t row = 0; row < element.count; ++row)
        if (const char* wrong = readRow(element, stream))
            return badInput(element.name + " " + std::to_string(row) + " of " + std::to_string(element.count) + ": " + wrong);
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
    return nullptr;
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
    if (!(*count >= 0 && *count <= static_cast<double>(stream.bytesLeft()))) return "a list that is longer than the file";
    list_.clear();
    for (auto left = static_cast<uint64_t>(*count); left > 0; --left) {
        const auto number = stream.next(property.type);
        if (!number) return kCutShort;
        list_.push_back(*number);
    }
    if (property.name == "vertex_indices" || property.name == "vertex_index") indices_ = list_;
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

const char* PlyReader::finishFace() {
    if (indices_.empty()) return "a face without vertex indices";
    corners_.clear();
    for (size_t k = 0; k < indices_.size(); ++k) {
        const bool is_whole = indices_[k] == std::floor(indices_[k]);
        if (!(is_whole && indices_[k] >= 0 && indices_[k] < static_cast<double>(attributes_.size())))
            return "it refers to a vertex that is not there; the file is damaged, export it again";
        corners_.push_back(attributes_[static_cast<size_t>(indices_[k])]);
        if (uvs_.size() == 2 * indices_.size())
            corners_.back().uv = {static_cast<float>(uvs_[2 * k]), static_cast<float>(1 - uvs_[2 * k + 1])};
    }
    return mesh_.addPolygon(corners_);
}

} // namespace

engine::Result<ImportedMesh> readPly(std::string_view bytes) { return PlyReader(bytes).run(); }

} // namespace brittle
