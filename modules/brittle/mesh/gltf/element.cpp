#include "modules/brittle/mesh/gltf/element.h"

#include <algorithm>
#include <cmath>

namespace brittle::gltf {
namespace {

constexpr uint64_t kLargestInteger = uint64_t{1} << 53;

uint64_t toInteger(const Json& value, const std::string& where, const std::string& name) {
    if (value.is_number_unsigned() && value.get<uint64_t>() <= kLargestInteger) return value.get<uint64_t>();
    if (value.is_number_float()) {
        const double number = value.get<double>();
        if (number >= 0 && number <= static_cast<double>(kLargestInteger) && number == std::floor(number))
            return static_cast<uint64_t>(number);
    }
    const std::string found = value.is_number() ? value.dump() : std::string(value.type_name());
    refuse(where, name + " is " + found + ", must be an integer from 0 to 2^53");
}

double toNumber(const Json& value, const std::string& where, const std::string& name) {
    if (!value.is_number()) refuse(where, name + " is " + value.type_name() + ", must be a number");
    const double number = value.get<double>();
    if (!std::isfinite(number)) refuse(where, name + " is not a finite number");
    return number;
}

bool isContinuation(char c) { return (static_cast<uint8_t>(c) & 0xC0) == 0x80; }

// Bytes of the UTF-8 character at the start of the text, 0 if these bytes are not UTF-8.
size_t characterBytes(std::string_view text) {
    const auto first = static_cast<uint8_t>(text[0]);
    const size_t bytes = first < 0x80 ? 1 : first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : first >= 0xC2 ? 2 : 0;
    if (bytes > text.size()) return 0;
    return std::ranges::all_of(text.substr(1, bytes > 0 ? bytes - 1 : 0), isContinuation) ? bytes : 0;
}

// Some programs write names in Latin-1. Converts bytes that are not UTF-8 from it.
std::string asUtf8(std::string_view text) {
    std::string whole;
    while (!text.empty()) {
        const size_t bytes = characterBytes(text);
        const auto byte = static_cast<uint8_t>(text[0]);
        if (bytes > 0)
            whole += text.substr(0, bytes);
        else
            whole += {static_cast<char>(0xC0 | byte >> 6), static_cast<char>(0x80 | (byte & 0x3F))};
        text.remove_prefix(std::max<size_t>(bytes, 1));
    }
    return whole;
}

Json parse(std::string_view text) {
    Json json = Json::parse(text, nullptr, /*allow_exceptions=*/false);
    if (!json.is_discarded()) return json;
    try {
        return Json::parse(asUtf8(text));
    } catch (const Json::parse_error& error) {
        refuse("the JSON", "cannot be read at byte " + std::to_string(error.byte));
    } catch (const Json::exception&) {
        refuse("the JSON", "cannot be read: a number is too large");
    }
}

} // namespace

void refuse(const std::string& where, const std::string& what, const std::string& advice) {
    throw Refusal{where + ": " + what + (advice.empty() ? "" : "; " + advice)};
}

Element::Element(const Json& json, std::string where) : json_(&json), where_(std::move(where)) {
    if (!json.is_object()) refuse(std::string("is ") + json.type_name() + ", must be a JSON object");
}

void Element::refuse(const std::string& what, const std::string& advice) const { gltf::refuse(where_, what, advice); }

const Json* Element::find(const char* key) const {
    const auto found = json_->find(key);
    return found == json_->end() ? nullptr : &*found;
}

std::optional<uint64_t> Element::integer(const char* key) const {
    const Json* value = find(key);
    if (!value) return std::nullopt;
    return toInteger(*value, where_, key);
}

uint64_t Element::requiredInteger(const char* key) const {
    if (const auto value = integer(key)) return *value;
    refuse(std::string(key) + " is missing");
}

std::optional<double> Element::number(const char* key) const {
    const Json* value = find(key);
    if (!value) return std::nullopt;
    return toNumber(*value, where_, key);
}

std::optional<std::string> Element::text(const char* key) const {
    const Json* value = find(key);
    if (!value) return std::nullopt;
    if (!value->is_string()) refuse(std::string(key) + " is " + value->type_name() + ", must be a string");
    return value->get<std::string>();
}

bool Element::flag(const char* key) const {
    const Json* value = find(key);
    if (!value) return false;
    if (!value->is_boolean()) refuse(std::string(key) + " is " + value->type_name() + ", must be true or false");
    return value->get<bool>();
}

const Json* Element::list(const char* key) const {
    const Json* value = find(key);
    if (value && !value->is_array()) refuse(std::string(key) + " is " + value->type_name() + ", must be an array");
    return value;
}

std::optional<std::vector<double>> Element::numbers(const char* key) const {
    const Json* values = list(key);
    if (!values) return std::nullopt;
    std::vector<double> numbers;
    for (const Json& value : *values)
        numbers.push_back(toNumber(value, where_, std::string(key) + "[" + std::to_string(numbers.size()) + "]"));
    return numbers;
}

std::optional<std::vector<double>> Element::numbers(const char* key, size_t size) const {
    auto found = numbers(key);
    if (found && found->size() != size)
        refuse(std::string(key) + " has " + std::to_string(found->size()) + " numbers, must have " + std::to_string(size));
    return found;
}

std::optional<std::vector<uint64_t>> Element::integers(const char* key) const {
    const Json* values = list(key);
    if (!values) return std::nullopt;
    std::vector<uint64_t> integers;
    for (const Json& value : *values)
        integers.push_back(toInteger(value, where_, std::string(key) + "[" + std::to_string(integers.size()) + "]"));
    return integers;
}

std::optional<Element> Element::object(const char* key) const {
    const Json* value = find(key);
    if (!value) return std::nullopt;
    return Element(*value, where_ + ", " + key);
}

Element Element::requiredObject(const char* key) const {
    if (const auto value = object(key)) return *value;
    refuse(std::string(key) + " is missing");
}

std::optional<Element> Element::extension(const char* name) const {
    const auto extensions = object("extensions");
    if (!extensions) return std::nullopt;
    const Json* value = extensions->find(name);
    if (!value) return std::nullopt;
    return Element(*value, where_ + ", " + name);
}

Document::Document(std::string_view text) : json_(parse(text)) {
    if (!json_.is_object()) refuse("the JSON", std::string("is ") + json_.type_name() + ", must be an object");
}

uint64_t Document::size(const char* list) const {
    const Json* elements = root().list(list);
    return elements ? elements->size() : 0;
}

Element Document::element(const char* list, uint64_t index, const std::string& user) const {
    std::string name = list;
    name.resize(name.size() - (name == "meshes" ? 2 : 1)); // in the singular
    const std::string where = name + " " + std::to_string(index);
    if (index >= size(list)) refuse(user, where + " is not there; the file has " + std::to_string(size(list)));
    return {(*root().list(list))[index], where};
}

} // namespace brittle::gltf
