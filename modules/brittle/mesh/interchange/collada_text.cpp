#include "modules/brittle/mesh/interchange/collada_text.h"

#include "modules/brittle/mesh/format.h"
#include "modules/brittle/mesh/readers.h"
#include "modules/brittle/mesh/text_reader.h"

#include <algorithm>

namespace brittle {
namespace {

// The start of an element: its name, its attributes, and the text up to the next tag. All are views into the file.
struct Tag {
    std::string_view name, attributes, content;
};

// Start tags one after the other; comments, declarations and end tags are skipped.
class TagReader {
public:
    explicit TagReader(std::string_view text) : rest_(text) {}
    std::optional<Tag> next();

private:
    void skipTo(std::string_view end);

    std::string_view rest_;
};

void TagReader::skipTo(std::string_view end) {
    const size_t at = rest_.find(end);
    rest_.remove_prefix(at == rest_.npos ? rest_.size() : at + end.size());
}

std::optional<Tag> TagReader::next() {
    while (true) {
        rest_.remove_prefix(std::min(rest_.find('<'), rest_.size()));
        if (rest_.empty()) return std::nullopt;
        if (rest_.starts_with("<!--"))
            skipTo("-->");
        else if (rest_.starts_with("<![CDATA["))
            skipTo("]]>");
        else if (rest_.starts_with("</") || rest_.starts_with("<?") || rest_.starts_with("<!"))
            skipTo(">");
        else
            break;
    }
    rest_.remove_prefix(1);
    const std::string_view tag = rest_.substr(0, rest_.find('>'));
    rest_.remove_prefix(std::min(tag.size() + 1, rest_.size()));
    const size_t name_end = std::min(tag.find_first_of(" \t\r\n/"), tag.size());
    return Tag{tag.substr(0, name_end), tag.substr(name_end), rest_.substr(0, rest_.find('<'))};
}

// The value of an attribute, empty if it is missing.
std::string_view valueOf(std::string_view attributes, std::string_view name) {
    for (size_t at = attributes.find(name); at != attributes.npos; at = attributes.find(name, at + 1)) {
        std::string_view behind = attributes.substr(at + name.size());
        behind.remove_prefix(std::min(behind.find_first_not_of(" \t\r\n"), behind.size()));
        if (at == 0 || !isBlank(attributes[at - 1]) || !behind.starts_with('=')) continue;
        behind.remove_prefix(std::min(behind.find_first_of("\"'"), behind.size()));
        if (behind.empty()) return {};
        return behind.substr(1, behind.find(behind.front(), 1) - 1);
    }
    return {};
}

std::string unescaped(std::string_view text) {
    static constexpr std::pair<std::string_view, char> kEntities[] = {
        {"&quot;", '"'}, {"&apos;", '\''}, {"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}};
    std::string plain;
    while (!text.empty()) {
        const auto* entity = std::ranges::find_if(kEntities, [&](const auto& e) { return text.starts_with(e.first); });
        const bool is_entity = entity != std::end(kEntities);
        plain += is_entity ? entity->second : text.front();
        text.remove_prefix(is_entity ? entity->first.size() : 1);
    }
    return plain;
}

std::string_view trimmed(std::string_view text) { return Words(text).next(); }

class ColladaCheck {
public:
    explicit ColladaCheck(std::string_view text) : text_(text) {}
    engine::Result<ColladaText> run();

private:
    // nullptr if all is well, else what is wrong with the element.
    const char* check(const Tag& tag);
    const char* checkIndices(std::string_view indices) const;
    void checkUnit(const Tag& tag);
    void checkAxis(const Tag& tag);
    size_t lineOf(const Tag& tag) const;

    std::string_view text_;
    ColladaText found_;
    std::string_view unit_in_file_; // its number
    std::string unit_;              // the same as assimp can read it
    bool has_count_ = false;        // the current primitive
    size_t scenes_ = 0;
};

size_t ColladaCheck::lineOf(const Tag& tag) const {
    const std::string_view before = text_.substr(0, static_cast<size_t>(tag.name.data() - text_.data()));
    return 1 + static_cast<size_t>(std::ranges::count(before, '\n'));
}

engine::Result<ColladaText> ColladaCheck::run() {
    TagReader tags(text_);
    while (const auto tag = tags.next())
        if (const char* wrong = check(*tag)) return badLine(lineOf(*tag), wrong);
    if (scenes_ > 1) found_.notes.push_back(formatCount(scenes_ - 1, "other scene is", "other scenes are") + " left out");
    found_.text = text_;
    if (!unit_in_file_.empty())
        found_.text.replace(static_cast<size_t>(unit_in_file_.data() - text_.data()), unit_in_file_.size(), unit_);
    return std::move(found_);
}

const char* ColladaCheck::check(const Tag& tag) {
    static constexpr std::string_view kPrimitives[] = {"polygons",  "polylist", "triangles", "trifans",
                                                       "tristrips", "lines",    "linestrips"};
    if (tag.name == "skew") return "<skew> is not read; apply the transforms of the nodes before export";
    if (tag.name == "ph") return "a polygon with holes; triangulate the model before export";
    if (std::ranges::count(kPrimitives, tag.name) > 0)
        has_count_ = Words(valueOf(tag.attributes, "count")).nextInt<uint64_t>().value_or(0) > 0;
    if (tag.name == "p") return checkIndices(tag.content);
    if (tag.name == "unit") checkUnit(tag);
    if (tag.name == "up_axis") checkAxis(tag);
    if (tag.name == "visual_scene") ++scenes_;
    if (tag.name == "geometry") found_.geometries.insert(unescaped(valueOf(tag.attributes, "id")));
    return nullptr;
}

// Assimp skips primitives without a count and takes a negative index for 0.
const char* ColladaCheck::checkIndices(std::string_view indices) const {
    if (trimmed(indices).empty()) return nullptr;
    if (!has_count_) return "primitives without a count; export the file again";
    return indices.find('-') == indices.npos ? nullptr : "a negative index; export the file again";
}

// A decimal comma has one meaning here.
void ColladaCheck::checkUnit(const Tag& tag) {
    const std::string_view written = valueOf(tag.attributes, "meter");
    if (written.empty() || !unit_in_file_.empty()) return;
    std::string unit(trimmed(written));
    std::ranges::replace(unit, ',', '.');
    const std::optional<double> meters = parseNumber(unit);
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
