#include "modules/brittle/mesh/text_reader.h"

#include <algorithm>
#include <limits>

namespace brittle {

std::optional<double> parseNumber(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    if (word.empty()) return std::nullopt;
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size()) return std::nullopt;
    if (error == std::errc::result_out_of_range) {
        const bool is_small = word.find("e-") != word.npos || word.find("E-") != word.npos;
        return is_small ? 0 : std::numeric_limits<double>::infinity();
    }
    if (error != std::errc()) return std::nullopt;
    return value;
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

TextReader::TextReader(std::string_view text) : rest_(withoutMark(text)) {
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

std::string_view TextReader::nextFullLine(char comment) {
    while (!atEnd()) {
        std::string_view line = nextLine();
        line = line.substr(0, line.find(comment));
        if (!std::all_of(line.begin(), line.end(), isBlank)) return line;
    }
    return {};
}

} // namespace brittle
