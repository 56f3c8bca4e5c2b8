#include "modules/brittle/mesh/format.h"
#include "modules/brittle/scene/scene_file.h"
#include "modules/brittle/scene/scene_keys.h"

#include <charconv>
#include <cmath>

namespace brittle {
namespace {

// The shortest text that is this number again.
std::string textOf(double x) {
    if (std::isnan(x)) return "nan";
    if (std::isinf(x)) return x > 0 ? "inf" : "-inf";
    std::array<char, 32> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), x).ptr;
    std::string text(digits.data(), end);
    // A whole number would be an integer, which has neither a negative zero nor as many digits as a double.
    const bool is_whole = text.find_first_of(".e") == text.npos;
    const bool fits = std::fabs(x) < 1e15 && !(x == 0 && std::signbit(x));
    return is_whole && !fits ? text + ".0" : text;
}

std::string escaped(char c) {
    switch (c) {
    case '"': return "\\\"";
    case '\\': return "\\\\";
    case '\n': return "\\n";
    case '\t': return "\\t";
    default: break;
    }
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte != 0x7f) return {c};
    std::array<char, 8> code;
    std::snprintf(code.data(), code.size(), "\\u%04X", byte);
    return code.data();
}

std::string textOf(const std::string& value) {
    std::string text = "\"";
    for (const char c : value)
        text += escaped(c);
    return text + "\"";
}

std::string textOf(const Double3& p);

template <class Items>
std::string listOf(const Items& items, const char* separator = ", ") {
    std::string text;
    for (const auto& item : items)
        text += (text.empty() ? "" : separator) + textOf(item);
    return "[" + text + "]";
}

std::string textOf(const Double3& p) { return listOf(p); }

std::string textOf(const std::vector<Double3>& points) { return listOf(points, ",\n          "); }

struct WriteValue {
    std::span<const std::string_view> names; // of choices

    std::string operator()(const double* x) const { return textOf(*x); }
    std::string operator()(const std::optional<double>* x) const { return *x ? textOf(**x) : ""; }
    std::string operator()(const uint32_t* x) const { return std::to_string(*x); }
    std::string operator()(const uint64_t* x) const { return std::to_string(*x); }
    std::string operator()(const bool* x) const { return *x ? "true" : "false"; }
    std::string operator()(const std::string* x) const { return textOf(*x); }
    std::string operator()(const ChoiceRef& x) const {
        return *x.number < names.size() ? textOf(std::string(names[*x.number])) : textOf(std::to_string(*x.number));
    }
    std::string operator()(const Double3* x) const { return listOf(*x); }
    std::string operator()(const Quaternion* x) const { return listOf(*x); }
    std::string operator()(const std::vector<Double3>* x) const { return textOf(*x); }
    std::string operator()(const std::vector<std::string>* x) const { return listOf(*x); }
};

std::string keysOf(const SceneSection& section, void* owner) {
    std::string text;
    for (const SceneKey& key : section.keys) {
        const ValueRef value = key.locate(owner);
        const bool always = key.name == "shape";
        if (always || !sameValue(value, defaultOf(section, key)))
            text += std::string(key.name) + " = " + formatValue(value, key.allowed) + "\n";
    }
    return text;
}

} // namespace

std::string formatValue(const ValueRef& value, const Allowed& allowed) { return std::visit(WriteValue{allowed.names}, value); }

std::string writeScene(const SceneDescription& scene) {
    SceneDescription copy = scene; // the table's references are for writing too
    std::string text;
    for (const SceneSection& section : sceneSections())
        for (size_t k = 0; k < countOf(copy, section.id); ++k) {
            const std::string keys = keysOf(section, ownerOf(copy, section.id, k));
            if (keys.empty()) continue;
            if (!section.name.empty()) text += (text.empty() ? "" : "\n") + headingOf(section) + "\n";
            text += keys;
        }
    return text;
}

} // namespace brittle
