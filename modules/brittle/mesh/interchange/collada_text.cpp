#include "modules/brittle/mesh/interchange/collada_text.h"

#include "modules/brittle/mesh/format.h"
#include "modules/brittle/mesh/interchange/collada_arrays.h"
#include "modules/brittle/mesh/readers.h"
#include "modules/brittle/mesh/text_reader.h"
#include "modules/brittle/mesh/vector_math.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace brittle {
namespace {

std::string_view trimmed(std::string_view text) { return Words(text).next(); }

std::string quoted(std::string_view id) { return '"' + unescaped(id) + '"'; }

// nullopt unless the text is so many numbers.
template <size_t count>
std::optional<std::array<double, count>> numbersOf(std::string_view text) {
    std::array<double, count> numbers;
    Words words(text);
    for (double& number : numbers) {
        const auto parsed = parseColladaNumber(words.next());
        if (!parsed) return std::nullopt;
        number = *parsed;
    }
    return words.next().empty() ? std::optional(numbers) : std::nullopt;
}

class ColladaCheck {
public:
    explicit ColladaCheck(std::string_view text) : text_(text) {}
    engine::Result<ColladaText> run();

private:
    std::optional<ColladaFault> fault(const Tag& tag);
    // nullptr if all is well, else what is wrong with the element.
    const char* check(const Tag& tag);
    const char* checkIndices(std::string_view indices) const;
    const char* checkMatrix(std::string_view numbers) const;
    const char* checkRotation(std::string_view text);
    const char* checkLookat(std::string_view text) const;
    void checkController(const Tag& tag);
    void checkUnit(const Tag& tag);
    void checkAxis(const Tag& tag);
    size_t lineOf(std::string_view at) const;
    void addNotes();
    std::string editedText() const;

    std::string_view text_;
    ColladaText found_;
    ColladaArrays arrays_;
    std::vector<std::pair<std::string_view, std::string>> edits_; // parts of the file, and the same as assimp can read them
    std::vector<std::string> bound_shapes_;                       // controllers with a matrix that assimp does not apply
    std::string_view controller_;                                 // id of the last one
    bool has_unit_ = false;
    bool has_count_ = false; // the current primitive
    size_t scenes_ = 0;
};

size_t ColladaCheck::lineOf(std::string_view at) const {
    const std::string_view before = text_.substr(0, static_cast<size_t>(at.data() - text_.data()));
    return 1 + static_cast<size_t>(std::ranges::count(before, '\n'));
}

engine::Result<ColladaText> ColladaCheck::run() {
    TagReader tags(text_);
    while (const auto tag = tags.next())
        if (const auto found = fault(*tag)) return badLine(lineOf(found->at), found->what);
    addNotes();
    found_.text = editedText();
    return std::move(found_);
}

void ColladaCheck::addNotes() {
    if (!bound_shapes_.empty())
        found_.notes.push_back(formatCount(bound_shapes_.size(), "bind_shape_matrix of a controller is",
                                           "bind_shape_matrix elements of controllers are") +
                               " left out: " + formatList(bound_shapes_));
    if (scenes_ > 1) found_.notes.push_back(formatCount(scenes_ - 1, "other scene is", "other scenes are") + " left out");
    if (arrays_.longArrays() > 0)
        found_.notes.push_back("numbers behind those that an array counts are left out: " +
                               formatCount(arrays_.longArrays(), "array"));
}

// The edits are in the order of the file.
std::string ColladaCheck::editedText() const {
    std::string text;
    size_t done = 0;
    for (const auto& [part, replacement] : edits_) {
        const auto at = static_cast<size_t>(part.data() - text_.data());
        text.append(text_, done, at - done).append(replacement);
        done = at + part.size();
    }
    return text.append(text_, done);
}

std::optional<ColladaFault> ColladaCheck::fault(const Tag& tag) {
    if (const char* wrong = check(tag)) return ColladaFault{tag.name, wrong};
    return arrays_.check(tag);
}

const char* ColladaCheck::check(const Tag& tag) {
    static constexpr std::string_view kPrimitives[] = {"polygons", "polylist", "triangles", "tristrips", "lines", "linestrips"};
    if (tag.name == "skew") return "<skew> is not read; apply the transforms of the nodes before export";
    if (tag.name == "trifans") return "triangle fans (<trifans>) are not read; export triangles";
    if (tag.name == "morph") return "<morph> controllers are not read; apply the shapes to the mesh before export";
    if (tag.name == "ph") return "a polygon with holes; triangulate the model before export";
    if (std::ranges::count(kPrimitives, tag.name) > 0)
        has_count_ = Words(tag.value("count")).nextInt<uint64_t>().value_or(0) > 0;
    if (tag.name == "p") return checkIndices(tag.content);
    if (tag.name == "matrix") return checkMatrix(tag.content);
    if (tag.name == "rotate") return checkRotation(tag.content);
    if (tag.name == "lookat") return checkLookat(tag.content);
    checkController(tag);
    if (tag.name == "unit") checkUnit(tag);
    if (tag.name == "up_axis") checkAxis(tag);
    if (tag.name == "visual_scene") ++scenes_;
    if (tag.name == "geometry") found_.geometries.insert(unescaped(tag.value("id")));
    return nullptr;
}

// Assimp skips primitives without a count and takes a negative index for 0.
const char* ColladaCheck::checkIndices(std::string_view indices) const {
    if (trimmed(indices).empty()) return nullptr;
    if (!has_count_) return "primitives without a count; export the file again";
    return indices.find('-') == indices.npos ? nullptr : "a negative index; export the file again";
}

// Row by row. Assimp applies the upper three rows alone.
const char* ColladaCheck::checkMatrix(std::string_view numbers) const {
    static constexpr double kLastRow[] = {0, 0, 0, 1};
    constexpr double kRounding = 1e-6;
    Words words(numbers);
    for (size_t k = 0; k < 16; ++k) {
        const auto number = parseColladaNumber(words.next());
        if (!number) return nullptr; // assimp refuses it, if it is the matrix of a node
        if (k >= 12 && !(std::abs(*number - kLastRow[k - 12]) <= kRounding))
            return "a matrix must end in the row 0 0 0 1; export the file again";
    }
    return nullptr;
}

// Assimp takes the axis for a unit vector; another one would scale the model.
const char* ColladaCheck::checkRotation(std::string_view text) {
    constexpr double kRounding = 1e-7;
    const auto numbers = numbersOf<4>(text);
    if (!numbers) return nullptr; // assimp refuses it
    const auto [x, y, z, angle] = *numbers;
    const double length = std::hypot(x, y, z);
    if (length == 0 && angle == 0) return nullptr;
    if (!(length > 0) || !std::isfinite(length))
        return "the axis of a <rotate> has no direction; give it an axis other than 0 0 0, or remove it";
    if (std::abs(length - 1) <= kRounding) return nullptr;
    std::array<char, 128> unit;
    std::snprintf(unit.data(), unit.size(), "%.9g %.9g %.9g %.9g", x / length, y / length, z / length, angle);
    edits_.emplace_back(text, unit.data());
    return nullptr;
}

// Assimp makes a matrix of zeros of it.
const char* ColladaCheck::checkLookat(std::string_view text) const {
    const auto n = numbersOf<9>(text);
    if (!n) return nullptr; // assimp refuses it
    const Double3 eye = {(*n)[0], (*n)[1], (*n)[2]}, target = {(*n)[3], (*n)[4], (*n)[5]}, up = {(*n)[6], (*n)[7], (*n)[8]};
    const double side = length(cross(target - eye, up));
    return side > 0 ? nullptr : "a <lookat> without a direction, or whose up is parallel to it; replace it by a <matrix>";
}

void ColladaCheck::checkController(const Tag& tag) {
    constexpr double kRounding = 1e-6;
    if (tag.name == "controller") controller_ = tag.value("id");
    const auto matrix = tag.name == "bind_shape_matrix" ? numbersOf<16>(tag.content) : std::nullopt;
    if (!matrix) return;
    bool is_identity = true;
    for (size_t k = 0; k < 16; ++k)
        is_identity &= std::abs((*matrix)[k] - (k % 5 == 0 ? 1 : 0)) <= kRounding;
    if (!is_identity) bound_shapes_.push_back(quoted(controller_));
}

void ColladaCheck::checkUnit(const Tag& tag) {
    const std::string_view written = tag.value("meter");
    if (written.empty() || has_unit_) return;
    has_unit_ = true;
    std::string unit(trimmed(written));
    std::ranges::replace(unit, ',', '.');
    const std::optional<double> meters = parseColladaNumber(unit);
    const bool is_possible = meters && std::isfinite(*meters) && *meters > 0;
    edits_.emplace_back(written, is_possible ? unit : "1");
    if (!is_possible)
        found_.notes.push_back("unit meter is \"" + std::string(written) + "\", must be a number above 0; taken as 1 meter");
}

void ColladaCheck::checkAxis(const Tag& tag) {
    const std::string_view axis = trimmed(tag.content);
    if (axis.size() < tag.content.size()) edits_.emplace_back(tag.content, axis);
    if (axis == "X_UP" || axis == "Y_UP" || axis == "Z_UP") return;
    found_.notes.push_back("up_axis is \"" + std::string(axis) + "\", must be X_UP, Y_UP or Z_UP; taken as Y_UP");
}

} // namespace

engine::Result<ColladaText> checkCollada(std::string_view text) {
    const std::string without_comments = withBlankComments(text);
    return ColladaCheck(without_comments).run();
}

} // namespace brittle
