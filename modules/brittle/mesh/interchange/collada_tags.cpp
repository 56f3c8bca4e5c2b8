#include "modules/brittle/mesh/interchange/collada_tags.h"

#include "modules/brittle/mesh/text_reader.h"

#include <algorithm>

namespace brittle {

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

std::string_view Tag::value(std::string_view attribute) const {
    for (size_t at = attributes.find(attribute); at != attributes.npos; at = attributes.find(attribute, at + 1)) {
        std::string_view behind = attributes.substr(at + attribute.size());
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

std::string withBlankComments(std::string_view text) {
    constexpr std::string_view kComment = "<!--", kCommentEnd = "-->", kData = "<![CDATA[", kDataEnd = "]]>";
    std::string blank(text);
    for (size_t at = blank.find("<!"); at < blank.size(); at = blank.find("<!", at + 1)) {
        const bool is_comment = text.substr(at).starts_with(kComment);
        if (!is_comment && !text.substr(at).starts_with(kData)) continue;
        const size_t end = is_comment ? text.find(kCommentEnd, at + kComment.size()) : text.find(kDataEnd, at);
        if (end == text.npos) break; // assimp refuses the file
        for (; is_comment && at < end + kCommentEnd.size(); ++at)
            if (blank[at] != '\n' && blank[at] != '\r') blank[at] = ' ';
        at = end;
    }
    return blank;
}

std::optional<double> parseColladaNumber(std::string_view word) {
    if (const auto number = parseNumber(word)) return number;
    std::string with_point(word);
    std::ranges::replace(with_point, ',', '.');
    return parseNumber(with_point);
}

} // namespace brittle
