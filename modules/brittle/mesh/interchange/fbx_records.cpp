#include "modules/brittle/mesh/interchange/fbx_records.h"

#include "modules/brittle/mesh/format.h"
#include "modules/brittle/mesh/text_reader.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <type_traits>

namespace brittle {
namespace {

using Visit = std::function<void(const FbxRecord&)>;

constexpr size_t kMostValues = 7; // of a property that is a vector
constexpr std::string_view kProperty = "P", kProperties = "Properties70", kDeformPercent = "DeformPercent";

bool isOfInterest(std::string_view section) { return section == "Objects" || section == "Connections"; }
bool hasProperties(std::string_view section, std::string_view key) {
    return section == "Objects" && (key == "Model" || key == "Deformer");
}

// The numbers of a `P` stand behind its name, type, label and flags.
FbxProperty propertyOf(std::string_view key, const std::vector<std::string>& values) {
    const bool is_named = key == kProperty && !values.empty();
    FbxProperty property{is_named ? values.front() : std::string(key), {}};
    for (size_t k = is_named ? 4 : 0; k < values.size(); ++k)
        property.numbers.push_back(parseNumber(values[k]).value_or(0));
    return property;
}

// ---- binary: every record begins with the offset of its end
// ------------------------------------------------------------------

constexpr std::string_view kBinaryMagic = "Kaydara FBX Binary";
constexpr size_t kVersionOffset = 23, kFirstRecord = 27;

template <class T>
std::optional<T> numberAt(std::string_view bytes, size_t at) {
    if (at > bytes.size() || sizeof(T) > bytes.size() - at) return std::nullopt;
    T number;
    std::memcpy(&number, bytes.data() + at, sizeof number);
    return number;
}

struct BinaryHead {
    uint64_t end = 0, value_count = 0, values_size = 0;
    std::string_view key;
    size_t values_begin = 0;
};

class BinaryWalk {
public:
    BinaryWalk(std::string_view bytes, const Visit& visit)
        : bytes_(bytes), visit_(visit), is_wide_(numberAt<uint32_t>(bytes, kVersionOffset).value_or(0) >= 7500) {}
    void run();

private:
    std::optional<BinaryHead> headAt(size_t at) const;
    uint64_t wordAt(size_t at) const;
    std::vector<std::string> valuesOf(const BinaryHead& head) const;
    std::vector<FbxProperty> propertiesOf(const BinaryHead& head) const;

    // Calls visit(record) for all that lie within another.
    template <class VisitHead>
    void forEachChild(const BinaryHead& parent, const VisitHead& visit) const {
        const size_t first = parent.values_begin + parent.values_size;
        for (auto record = headAt(first); record && record->end <= parent.end; record = headAt(record->end))
            visit(*record);
    }
    std::string_view bytes_;
    const Visit& visit_;
    bool is_wide_; // offsets of 64 bits, since version 7.5
};

uint64_t BinaryWalk::wordAt(size_t at) const {
    return is_wide_ ? numberAt<uint64_t>(bytes_, at).value_or(0) : numberAt<uint32_t>(bytes_, at).value_or(0);
}

// nullopt behind the last record of a list, and if the file is damaged.
std::optional<BinaryHead> BinaryWalk::headAt(size_t at) const {
    const size_t word = is_wide_ ? 8 : 4;
    const auto name_size = numberAt<uint8_t>(bytes_, at + 3 * word);
    if (!name_size) return std::nullopt;
    BinaryHead head{wordAt(at), wordAt(at + word), wordAt(at + 2 * word), {}, at + 3 * word + 1 + *name_size};
    if (head.end <= at || head.end > bytes_.size() || head.values_begin > head.end) return std::nullopt;
    if (head.values_size > head.end - head.values_begin) return std::nullopt;
    head.key = bytes_.substr(head.values_begin - *name_size, *name_size);
    return head;
}

template <class T>
std::string takeNumber(std::string_view bytes, size_t& at) {
    const T number = numberAt<T>(bytes, at).value_or(0);
    at += sizeof number;
    if constexpr (std::is_integral_v<T>)
        return std::to_string(number);
    else
        return formatNumber(static_cast<double>(number));
}

// nullopt if it reaches beyond the end.
std::optional<std::string> takeText(std::string_view bytes, size_t& at) {
    const auto size = numberAt<uint32_t>(bytes, at);
    at += sizeof(uint32_t);
    if (!size || at > bytes.size() || *size > bytes.size() - at) return std::nullopt;
    at += *size;
    return std::string(bytes.substr(at - *size, *size));
}

// Moves `at` behind the value. nullopt if it is neither a number nor a text.
std::optional<std::string> takeValue(std::string_view bytes, size_t& at) {
    switch (bytes[at++]) {
    case 'L': return takeNumber<int64_t>(bytes, at);
    case 'I': return takeNumber<int32_t>(bytes, at);
    case 'Y': return takeNumber<int16_t>(bytes, at);
    case 'C': return takeNumber<int8_t>(bytes, at);
    case 'D': return takeNumber<double>(bytes, at);
    case 'F': return takeNumber<float>(bytes, at);
    case 'S': return takeText(bytes, at);
    default: return std::nullopt;
    }
}

// Stops at the first value that is neither a number nor a text.
std::vector<std::string> BinaryWalk::valuesOf(const BinaryHead& head) const {
    const std::string_view bytes = bytes_.substr(0, head.values_begin + head.values_size);
    std::vector<std::string> values;
    for (size_t at = head.values_begin; at < bytes.size() && values.size() < std::min(kMostValues, head.value_count);) {
        auto value = takeValue(bytes, at);
        if (!value) break;
        values.push_back(std::move(*value));
    }
    return values;
}

std::vector<FbxProperty> BinaryWalk::propertiesOf(const BinaryHead& head) const {
    std::vector<FbxProperty> properties;
    const auto add = [&](const BinaryHead& property) { properties.push_back(propertyOf(property.key, valuesOf(property))); };
    forEachChild(head, [&](const BinaryHead& child) {
        if (child.key == kDeformPercent) add(child);
        if (child.key == kProperties) forEachChild(child, add);
    });
    return properties;
}

void BinaryWalk::run() {
    for (auto section = headAt(kFirstRecord); section; section = headAt(section->end)) {
        if (!isOfInterest(section->key)) continue;
        forEachChild(*section, [&](const BinaryHead& record) {
            FbxRecord found{section->key, record.key, valuesOf(record), {}};
            if (hasProperties(section->key, record.key)) found.properties = propertiesOf(record);
            visit_(found);
        });
    }
}

// ---- text: KEY: value, "value" { ... }
// ----------------------------------------------------------------------------------------

class TextWalk {
public:
    TextWalk(std::string_view text, const Visit& visit) : rest_(text), visit_(visit) {}
    void run();

private:
    void readText();
    void readWord();
    void begin(std::string_view key);
    void addValue(std::string_view value);
    void finish();
    void finishProperty();
    void close();

    std::string_view rest_;
    const Visit& visit_;
    size_t depth_ = 0;
    std::string_view section_;
    FbxRecord record_;
    std::string_view property_; // its key
    std::vector<std::string> property_values_;
    bool is_open_ = false; // the record
    bool is_property_open_ = false;
};

void TextWalk::run() {
    while (!rest_.empty()) {
        const char c = rest_.front();
        if (c == '"') {
            readText();
        } else if (c == ';') {
            rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size()));
        } else if (c == '{' || c == '}') {
            rest_.remove_prefix(1);
            if (c == '{')
                ++depth_;
            else
                close();
        } else if (c == ',' || c == ' ' || c == '\t' || c == '\r' || c == '\n') {
            rest_.remove_prefix(1);
        } else {
            readWord();
        }
    }
    finish();
}

void TextWalk::readText() {
    const size_t end = std::min(rest_.find('"', 1), rest_.size());
    addValue(rest_.substr(1, end - 1));
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
}

void TextWalk::readWord() {
    const size_t end = std::min(rest_.find_first_of(",:{}\"; \t\r\n"), rest_.size());
    const std::string_view word = rest_.substr(0, end);
    rest_.remove_prefix(end);
    if (!rest_.starts_with(':')) return addValue(word);
    rest_.remove_prefix(1);
    begin(word);
}

void TextWalk::begin(std::string_view key) {
    finishProperty();
    if (depth_ > 1) {
        is_property_open_ =
            is_open_ && hasProperties(section_, record_.key) && key == (depth_ == 2 ? kDeformPercent : kProperty);
        property_ = key;
        return;
    }
    finish();
    if (depth_ == 0) section_ = key;
    is_open_ = depth_ == 1 && isOfInterest(section_);
    record_ = {section_, key, {}, {}};
}

void TextWalk::addValue(std::string_view value) {
    if (is_property_open_ && property_values_.size() < kMostValues) property_values_.emplace_back(value);
    if (is_open_ && depth_ == 1 && record_.values.size() < kMostValues) record_.values.emplace_back(value);
}

void TextWalk::finishProperty() {
    if (is_property_open_) record_.properties.push_back(propertyOf(property_, property_values_));
    is_property_open_ = false;
    property_values_.clear();
}

void TextWalk::finish() {
    if (is_open_) visit_(record_);
    is_open_ = false;
}

void TextWalk::close() {
    finishProperty();
    if (depth_ == 1) finish();
    depth_ -= depth_ > 0 ? 1 : 0;
}

} // namespace

void forEachFbxRecord(std::string_view fbx, const Visit& visit) {
    if (fbx.starts_with(kBinaryMagic))
        BinaryWalk(fbx, visit).run();
    else
        TextWalk(fbx, visit).run();
}

} // namespace brittle
