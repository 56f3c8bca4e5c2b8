#include "modules/brittle/mesh/text_reader.h"

#include <algorithm>
#include <limits>

namespace brittle {

namespace {

// Windows programs used to write NaN and infinity as 1.#QNAN, -1.#IND and 1.#INF.
bool isOldNan(std::string_view word) {
    if (word.starts_with('-') || word.starts_with('+')) word.remove_prefix(1);
    for (const char* name : {"1.#IND", "1.#INF", "1.#QNAN", "1.#SNAN"})
        if (word.starts_with(name)) return true;
    return false;
}

} // namespace

std::optional<double> parseNumber(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    if (word.empty()) return std::nullopt;
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size())
        return isOldNan(word) ? std::optional(std::numeric_limits<double>::quiet_NaN()) : std::nullopt;
    if (error == std::errc::result_out_of_range) {
        const bool is_small = word.find("e-") != word.npos || word.find("E-") != word.npos;
        return is_small ? 0 : std::numeric_limits<double>::infinity();
    }
    if (error != std::errc()) return std::nullopt;
    return value;
}

std::string_view withoutComment(std::string_view line) {
    for (size_t at = line.find('#'); at != line.npos; at = line.find('#', at + 1))
        if (at == 0 || !isOldNan(line.substr(at - (at > 1 ? 2 : 1)))) return line.substr(0, at);
    return line;
}

std::string_view Words::next() {
    size_t first = 0;
    while (first < rest_.size() && isBlank(rest_[first]))
        ++first;
    size_t last = first;
    while (last < rest_.size() && !isBlank(rest_[last]))
        ++last;
    const std::string_view word = rest_.substr(first, last - first);
    rest_.remove_prefix(last);
    return word;
}

std::optional<double> Words::nextNumber() { return parseNumber(next()); }

TextReader::TextReader(std::string_view text, size_t lines_before) : rest_(withoutMark(text)), line_(lines_before) {
    const size_t end = text.find_first_of("\r\n");
    ends_with_cr_ = end != text.npos && text[end] == '\r' && !text.substr(end + 1).starts_with('\n');
}

std::string_view TextReader::nextLine() {
    line_ += inside_line_ ? 0 : 1;
    inside_line_ = false;
    size_t end = 0;
    while (end < rest_.size() && rest_[end] != '\n' && rest_[end] != '\r')
        ++end;
    const std::string_view line = rest_.substr(0, end);
    const bool two = !ends_with_cr_ && end + 1 < rest_.size() && rest_[end] == '\r' && rest_[end + 1] == '\n';
    rest_.remove_prefix(std::min(rest_.size(), end + (two ? 2 : 1)));
    return line;
}

std::string_view TextReader::nextWord() {
    if (!inside_line_) ++line_;
    inside_line_ = true;
    size_t first = 0;
    for (; first < rest_.size() && isBlank(rest_[first]); ++first) {
        const bool ends_line =
            rest_[first] == '\n' || (rest_[first] == '\r' && (first + 1 == rest_.size() || rest_[first + 1] != '\n'));
        line_ += ends_line ? 1 : 0;
    }
    size_t last = first;
    while (last < rest_.size() && !isBlank(rest_[last]))
        ++last;
    const std::string_view word = rest_.substr(first, last - first);
    rest_.remove_prefix(last);
    return word;
}

std::string_view TextReader::nextFullLine() {
    while (!atEnd()) {
        const std::string_view line = withoutComment(nextLine());
        if (!std::all_of(line.begin(), line.end(), isBlank)) return line;
    }
    return {};
}

} // namespace brittle
