// Walks text line by line and word by word, for the model files that are text. Never looks past the end, whatever the file
// holds; knows the line it is in, for messages.
#pragma once

#include "modules/brittle/mesh/mesh.h"

#include <charconv>
#include <optional>
#include <string>
#include <string_view>

namespace brittle {

inline bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f'; }

// Words of one line; a view into text that must outlive it.
class Words {
public:
    explicit Words(std::string_view text) : rest_(text) {}
    // Empty at the end.
    std::string_view next();
    // nullopt if the word is not a number. Numbers too large for a double are infinite, too small ones are 0.
    std::optional<double> nextNumber();
    template <class Int>
    std::optional<Int> nextInt() {
        const std::string_view word = next();
        Int value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (word.empty() || error != std::errc() || end != word.data() + word.size()) return std::nullopt;
        return value;
    }

private:
    std::string_view rest_;
};

// Returns the same as Words::nextNumber.
std::optional<double> parseNumber(std::string_view word);

// Cuts off what follows a #. The one in 1.#QNAN begins no comment.
std::string_view withoutComment(std::string_view line);

// Compares without regard to case; `lower` is in lower case.
inline bool isWord(std::string_view word, std::string_view lower) {
    if (word.size() != lower.size()) return false;
    for (size_t k = 0; k < word.size(); ++k)
        if ((word[k] >= 'A' && word[k] <= 'Z' ? word[k] - 'A' + 'a' : word[k]) != lower[k]) return false;
    return true;
}

constexpr const char* kDecimalComma = "a number with a comma; write decimal points and export again";
inline bool hasComma(std::string_view text) { return text.find(',') != text.npos; }

// Some editors begin a text with a byte order mark.
inline std::string_view withoutMark(std::string_view text) { return text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text; }

class TextReader {
public:
    // `lines_before` counts the lines of the file before the text, for line().
    explicit TextReader(std::string_view text, size_t lines_before = 0);
    bool atEnd() const { return rest_.empty(); }
    size_t line() const { return line_; } // of the last word or line, from 1
    std::string_view rest() const { return rest_; }

    // Ends at \n, \r\n or \r, which are not part of it.
    std::string_view nextLine();
    // The next word, over any line ends; empty at the end of the text.
    std::string_view nextWord();
    // The next line that holds more than blanks and a comment, without its comment. Empty at the end of the text.
    std::string_view nextFullLine();

private:
    std::string_view rest_;
    size_t line_ = 0;
    bool inside_line_ = false;  // nextWord stopped within line_
    bool ends_with_cr_ = false; // lines end at \r alone: a \n after one is the first byte of what follows
};

} // namespace brittle
