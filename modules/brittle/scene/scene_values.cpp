// What values of keys may be, in words and as checks.
#include "modules/brittle/mesh/format.h"
#include "modules/brittle/scene/scene_keys.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace brittle {
namespace {

template <class... Cases>
struct Visitor : Cases... {
    using Cases::operator()...;
};
template <class... Cases>
Visitor(Cases...) -> Visitor<Cases...>;

std::string listOf(std::span<const std::string_view> names) {
    std::string text;
    for (const std::string_view name : names)
        text += (text.empty() ? "" : ", ") + std::string(name);
    return text;
}

std::string rangeOf(const Allowed& allowed) {
    const bool has_lower = std::isfinite(allowed.lower), has_upper = std::isfinite(allowed.upper);
    if (!has_lower || !has_upper) return "";
    if (allowed.above_lower) return " above " + formatNumber(allowed.lower) + " and at most " + formatNumber(allowed.upper);
    return " from " + formatNumber(allowed.lower) + " to " + formatNumber(allowed.upper);
}

std::string eachInRange(const Allowed& allowed) {
    const std::string range = rangeOf(allowed);
    return range.empty() ? "" : ", each" + range;
}

std::string describeWhole(const Allowed& allowed) {
    if (allowed.numbers.empty()) return "a whole number" + rangeOf(allowed);
    std::string text;
    for (const uint32_t number : allowed.numbers)
        text += (text.empty() ? "one of " : ", ") + std::to_string(number);
    return text;
}

std::string describeText(const Allowed& allowed) {
    if (allowed.names.empty()) return "a text";
    return "one of " + listOf(allowed.names) + (allowed.has_own_names ? ", or a name of the scene's own" : "");
}

std::string describeKind(const ValueRef& value, const Allowed& allowed) {
    return std::visit(
        Visitor{
            [&](const double*) { return "a number" + rangeOf(allowed); },
            [&](const std::optional<double>*) { return "a number" + rangeOf(allowed); },
            [&](const uint32_t*) { return describeWhole(allowed); },
            [&](const uint64_t*) { return describeWhole(allowed); },
            [](const bool*) { return std::string("true or false"); },
            [&](const std::string*) { return describeText(allowed); },
            [&](const ChoiceRef&) { return "one of " + listOf(allowed.names); },
            [&](const Double3*) { return "three numbers" + eachInRange(allowed); },
            [&](const Quaternion*) {
                return "four numbers that are not all 0" + eachInRange(allowed) + ", or an axis and degrees";
            },
            [&](const std::vector<Double3>*) { return "a list of points of three numbers" + eachInRange(allowed); },
            [&](const std::vector<std::string>*) { return "a list, without repeats, of " + listOf(allowed.names); },
        },
        value);
}

// NaN is in no range.
bool isIn(double x, const Allowed& allowed) {
    return std::isfinite(x) && (allowed.above_lower ? x > allowed.lower : x >= allowed.lower) && x <= allowed.upper;
}

std::string faultOfNumber(double x, const Allowed& allowed) { return isIn(x, allowed) ? "" : "is " + formatNumber(x); }

std::string faultOfWhole(uint64_t x, const Allowed& allowed) {
    if (!allowed.numbers.empty())
        return std::find(allowed.numbers.begin(), allowed.numbers.end(), x) != allowed.numbers.end()
                   ? ""
                   : "is " + std::to_string(x);
    return isIn(static_cast<double>(x), allowed) ? "" : "is " + std::to_string(x);
}

std::string faultOfPoint(const Double3& p, const Allowed& allowed) {
    for (const double x : p)
        if (!isIn(x, allowed)) return "holds " + formatNumber(x);
    return "";
}

std::string faultOfPoints(const std::vector<Double3>& points, const Allowed& allowed) {
    for (size_t k = 0; k < points.size(); ++k)
        if (const std::string fault = faultOfPoint(points[k], allowed); !fault.empty())
            return fault + " in point " + std::to_string(k);
    return "";
}

std::string faultOfTurn(const Quaternion& turn, const Allowed& allowed) {
    constexpr double kShortest = 1e-6;
    double length = 0;
    for (const double x : turn) {
        if (!isIn(x, allowed)) return "holds " + formatNumber(x);
        length = std::hypot(length, x);
    }
    if (length == 0) return "is no turn, since its numbers are all 0";
    if (length >= kShortest) return "";
    return "is no turn: its four numbers have a length of " + formatNumber(length) + ", less than " + formatNumber(kShortest);
}

bool isNamed(const std::string& name, const Allowed& allowed) {
    return std::find(allowed.names.begin(), allowed.names.end(), name) != allowed.names.end();
}

std::string faultOfText(const std::string& text, const Allowed& allowed) {
    if (allowed.names.empty() || allowed.has_own_names || text.empty() || isNamed(text, allowed)) return "";
    return "is '" + text + "'";
}

std::string faultOfNames(const std::vector<std::string>& list, const Allowed& allowed) {
    for (size_t k = 0; k < list.size(); ++k) {
        if (!isNamed(list[k], allowed)) return "holds '" + list[k] + "'";
        if (std::find(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(k), list[k]) !=
            list.begin() + static_cast<std::ptrdiff_t>(k))
            return "holds '" + list[k] + "' twice";
    }
    return "";
}

// To the last bit: -0 is not 0, and what is no number is the same as itself.
template <class Value>
bool areSame(const Value& a, const Value& b) {
    if constexpr (std::is_same_v<Value, double>)
        return std::bit_cast<uint64_t>(a) == std::bit_cast<uint64_t>(b);
    else if constexpr (requires { a.has_value(); })
        return a.has_value() == b.has_value() && (!a || areSame(*a, *b));
    else if constexpr (requires { a.begin(); } && !std::is_same_v<Value, std::string>)
        return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) { return areSame(x, y); });
    else
        return a == b;
}

} // namespace

std::string describeAllowed(const SceneKey& key) {
    // Any owner will do: only the type of the value matters. Found by the section that has the key.
    for (const SceneSection& section : sceneSections())
        if (&key >= section.keys.data() && &key < section.keys.data() + section.keys.size())
            return describeKind(defaultOf(section, key), key.allowed) +
                   (key.unit.empty() ? "" : " (" + std::string(key.unit) + ")");
    return "";
}

std::string faultOf(const ValueRef& value, const Allowed& allowed) {
    return std::visit(Visitor{
                          [&](const double* x) { return faultOfNumber(*x, allowed); },
                          [&](const std::optional<double>* x) { return *x ? faultOfNumber(**x, allowed) : ""; },
                          [&](const uint32_t* x) { return faultOfWhole(*x, allowed); },
                          [&](const uint64_t* x) { return faultOfWhole(*x, allowed); },
                          [](const bool*) { return std::string(); },
                          [&](const std::string* x) { return faultOfText(*x, allowed); },
                          [&](const ChoiceRef& x) {
                              return *x.number < allowed.names.size() ? "" : "is choice " + std::to_string(*x.number);
                          },
                          [&](const Double3* x) { return faultOfPoint(*x, allowed); },
                          [&](const Quaternion* x) { return faultOfTurn(*x, allowed); },
                          [&](const std::vector<Double3>* x) { return faultOfPoints(*x, allowed); },
                          [&](const std::vector<std::string>* x) { return faultOfNames(*x, allowed); },
                      },
                      value);
}

bool sameValue(const ValueRef& a, const ValueRef& b) {
    if (a.index() != b.index()) return false;
    return std::visit(
        [&](const auto& value) {
            using Ref = std::decay_t<decltype(value)>;
            if constexpr (std::is_same_v<Ref, ChoiceRef>)
                return *value.number == *std::get<ChoiceRef>(b).number;
            else
                return areSame(*value, *std::get<Ref>(b));
        },
        a);
}

} // namespace brittle
