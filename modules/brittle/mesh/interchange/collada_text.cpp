#include "modules/brittle/mesh/interchange/collada_text.h"

#include "modules/brittle/mesh/format.h"
#include "modules/brittle/mesh/interchange/collada_arrays.h"
#include "modules/brittle/mesh/readers.h"
#include "modules/brittle/mesh/text_reader.h"

#include <algorithm>

namespace brittle {
namespace {

std::string_view trimmed(std::string_view text) { return Words(text).next(); }

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
    void checkUnit(const Tag& tag);
    void checkAxis(const Tag& tag);
    size_t lineOf(std::string_view at) const;

    std::string_view text_;
    ColladaText found_;
    ColladaArrays arrays_;
    std::string_view unit_in_file_; // its number
    std::string unit_;              // the same as assimp can read it
    bool has_count_ = false;        // the current primitive
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
    if (scenes_ > 1) found_.notes.push_back(formatCount(scenes_ - 1, "other scene is", "other scenes are") + " left out");
    if (arrays_.longArrays() > 0)
        found_.notes.push_back("numbers behind those that an array counts are left out: " +
                               formatCount(arrays_.longArrays(), "array"));
    found_.text = text_;
    if (!unit_in_file_.empty())
        found_.text.replace(static_cast<size_t>(unit_in_file_.data() - text_.data()), unit_in_file_.size(), unit_);
    return std::move(found_);
}

std::optional<ColladaFault> ColladaCheck::fault(const Tag& tag) {
    if (const char* wrong = check(tag)) return ColladaFault{tag.name, wrong};
    return arrays_.check(tag);
}

const char* ColladaCheck::check(const Tag& tag) {
    static constexpr std::string_view kPrimitives[] = {"polygons",  "polylist", "triangles", "trifans",
                                                       "tristrips", "lines",    "linestrips"};
    if (tag.name == "skew") return "<skew> is not read; apply the transforms of the nodes before export";
    if (tag.name == "ph") return "a polygon with holes; triangulate the model before export";
    if (std::ranges::count(kPrimitives, tag.name) > 0)
        has_count_ = Words(tag.value("count")).nextInt<uint64_t>().value_or(0) > 0;
    if (tag.name == "p") return checkIndices(tag.content);
    if (tag.name == "matrix") return checkMatrix(tag.content);
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

void ColladaCheck::checkUnit(const Tag& tag) {
    const std::string_view written = tag.value("meter");
    if (written.empty() || !unit_in_file_.empty()) return;
    std::string unit(trimmed(written));
    std::ranges::replace(unit, ',', '.');
    const std::optional<double> meters = parseColladaNumber(unit);
    const bool is_possible = meters && std::isfinite(*meters) && *meters > 0;
    unit_in_file_ = written;
    unit_ = is_possible ? unit : "1";
    if (!is_possible)
        found_.notes.push_back("unit meter is \"" + std::string(written) + "\", must be a number above 0; taken as 1 meter");
}

void ColladaCheck::checkAxis(const Tag& tag) {
    const std::string_view axis = trimmed(tag.content);
    if (axis == "X_UP" || axis == "Y_UP" || axis == "Z_UP") return;
    found_.notes.push_back("up_axis is \"" + std::string(axis) + "\", must be X_UP, Y_UP or Z_UP; taken as Y_UP");
}

} // namespace

engine::Result<ColladaText> checkCollada(std::string_view text) { return ColladaCheck(text).run(); }

} // namespace brittle
