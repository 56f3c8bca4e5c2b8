// What is wrong with a source, and where, in the form that editors find their way by.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace engine {

enum class Severity { Error, Warning };

struct Diagnostic {
    Severity severity = Severity::Error;
    std::string file;    // as it was opened
    uint32_t line = 0;   // from 1; 0: of the file as a whole
    uint32_t column = 0; // from 1; 0: of the line as a whole
    std::string message;
};

// "FILE:LINE:COLUMN: error: MESSAGE", without the parts that are 0.
std::string textOf(const Diagnostic& diagnostic);
std::string textOf(const std::vector<Diagnostic>& diagnostics); // a line each

// Where the code of a line begins, from 1; 0 where there is none.
uint32_t firstColumn(const std::string& file, uint32_t line);

bool hasErrors(const std::vector<Diagnostic>& diagnostics);

// What glslang's log says. It knows lines only: the column is that of the name that the message quotes, where the line has it.
// What names no file is of `file`.
std::vector<Diagnostic> readCompilerLog(std::string_view log, const std::string& file);

} // namespace engine
