// Readers of our own for the four formats that carry bare triangles. They keep every digit of a double, take nothing on
// trust (a count in a header allocates nothing) and say where a broken file breaks. Errors do not name the file.
//
// Programs write these formats in many ways. A reader accepts what has only one meaning; if it leaves something out, a note of
// the mesh says so.
#pragma once

#include "engine/result.h"
#include "modules/brittle/mesh/imported_mesh.h"

#include <cmath>
#include <string>
#include <string_view>

namespace brittle {

engine::Result<ImportedMesh> readObj(std::string_view bytes);
engine::Result<ImportedMesh> readOff(std::string_view bytes);
engine::Result<ImportedMesh> readPly(std::string_view bytes);
engine::Result<ImportedMesh> readStl(std::string_view bytes);

// For the readers themselves.
engine::Error badInput(std::string message);
engine::Error badLine(size_t line, const std::string& message);
bool looksBinary(std::string_view bytes); // holds a zero byte, which no text does
// Refuses binary data and UTF-16; `format` is the name for the message.
engine::Result<void> checkIsText(std::string_view bytes, const char* format);
bool isUtf16(std::string_view bytes);
// Cuts off the zeros and the old end mark that may follow a text.
std::string_view withoutPadding(std::string_view bytes);
// Messages of libraries may run over lines and pages.
std::string oneLine(std::string text);

constexpr const char* kNotFinite = "a coordinate is not a finite number; remove that vertex and export again";
constexpr const char* kUtf16 = "saved as UTF-16; save it as ASCII or UTF-8";

// Counts what a reader leaves out, for one note at the end.
class LeftOut {
public:
    void add(size_t line) {
        if (count_++ == 0) first_line_ = line;
    }
    size_t count() const { return count_; }
    // "3 lines (first in line 12)", with the noun in its singular.
    std::string described(const std::string& noun) const;

private:
    size_t count_ = 0, first_line_ = 0;
};

} // namespace brittle
