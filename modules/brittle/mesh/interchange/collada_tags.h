// Reads the tags of an XML text one after the other. No document is built.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace brittle {

// The start of an element: its name, its attributes, and the text up to the next tag. All are views into the file.
struct Tag {
    std::string_view name, attributes, content;

    // The value of an attribute, empty if it is missing.
    std::string_view value(std::string_view attribute) const;
};

// Reads start tags; comments, declarations and end tags are skipped.
class TagReader {
public:
    explicit TagReader(std::string_view text) : rest_(text) {}
    std::optional<Tag> next();

private:
    void skipTo(std::string_view end);

    std::string_view rest_;
};

// The text with &amp; and the like replaced by what they stand for.
std::string unescaped(std::string_view text);

// The text with blanks in place of comments. Line ends stay, so that lines keep their numbers.
std::string withBlankComments(std::string_view text);

// Parses a number of COLLADA. A decimal comma has one meaning there, because blanks part the numbers.
std::optional<double> parseColladaNumber(std::string_view word);

} // namespace brittle
