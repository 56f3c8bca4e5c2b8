#include "engine/reload/diagnostic.h"

#include <algorithm>
#include <cctype>
#include <fstream>

namespace engine {
namespace {

constexpr std::string_view kError = "ERROR: ", kWarning = "WARNING: ";

std::string lineOf(const std::string& file, uint32_t number) {
    std::ifstream stream(file);
    std::string line;
    for (uint32_t k = 0; k < number; ++k)
        if (!std::getline(stream, line)) return {};
    return line;
}

bool isNamePart(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

// Where a name stands in a line, not as a part of another one; from 1, or 0.
uint32_t columnOf(const std::string& line, const std::string& name) {
    if (name.empty()) return 0;
    for (size_t at = line.find(name); at != std::string::npos; at = line.find(name, at + 1)) {
        const size_t end = at + name.size();
        const bool begins = at == 0 || !isNamePart(line[at - 1]) || !isNamePart(name.front());
        const bool ends = end == line.size() || !isNamePart(line[end]) || !isNamePart(name.back());
        if (begins && ends) return static_cast<uint32_t>(at + 1);
    }
    return 0;
}

std::string quotedIn(const std::string& message) {
    if (message.empty() || message.front() != '\'') return {};
    const size_t end = message.find('\'', 1);
    return end == std::string::npos ? "" : message.substr(1, end - 1);
}

// "FILE:LINE: MESSAGE", of which the file may hold colons.
bool splitPlace(std::string_view text, Diagnostic& found) {
    for (size_t colon = text.find(':'); colon != std::string_view::npos; colon = text.find(':', colon + 1)) {
        size_t end = colon + 1;
        uint32_t line = 0;
        for (; end < text.size() && std::isdigit(static_cast<unsigned char>(text[end])) != 0; ++end)
            line = 10 * line + static_cast<uint32_t>(text[end] - '0');
        if (end == colon + 1 || text.substr(end, 2) != ": ") continue;
        found.file = text.substr(0, colon);
        found.line = line;
        found.message = text.substr(end + 2);
        return true;
    }
    return false;
}

// "'name' :  what" and what is left of a message that has nothing to add.
std::string tidied(std::string message) {
    constexpr std::string_view kAboutNothing = "'' : ";
    if (message.starts_with(kAboutNothing)) message.erase(0, kAboutNothing.size());
    while (!message.empty() && message.front() == ' ')
        message.erase(0, 1);
    while (!message.empty() && std::isspace(static_cast<unsigned char>(message.back())) != 0)
        message.pop_back();
    return message;
}

// What only sums up the lines before it.
bool isTotal(std::string_view text) {
    return text.find(" compilation errors.") != std::string_view::npos ||
           text.find("compilation terminated") != std::string_view::npos;
}

} // namespace

std::string textOf(const Diagnostic& diagnostic) {
    std::string text = diagnostic.file;
    if (diagnostic.line != 0) text += ":" + std::to_string(diagnostic.line);
    if (diagnostic.line != 0 && diagnostic.column != 0) text += ":" + std::to_string(diagnostic.column);
    text += diagnostic.severity == Severity::Error ? ": error: " : ": warning: ";
    text += diagnostic.message;
    std::ranges::replace_if(
        text, [](char c) { return std::iscntrl(static_cast<unsigned char>(c)) != 0; }, '?'); // of names
    return text;
}

std::string textOf(const std::vector<Diagnostic>& diagnostics) {
    std::string text;
    for (const Diagnostic& diagnostic : diagnostics)
        text += (text.empty() ? "" : "\n") + textOf(diagnostic);
    return text;
}

uint32_t firstColumn(const std::string& file, uint32_t line) {
    const size_t at = lineOf(file, line).find_first_not_of(" \t");
    return at == std::string::npos ? 0 : static_cast<uint32_t>(at + 1);
}

bool hasErrors(const std::vector<Diagnostic>& diagnostics) {
    return std::ranges::any_of(diagnostics, [](const Diagnostic& d) { return d.severity == Severity::Error; });
}

std::vector<Diagnostic> readCompilerLog(std::string_view log, const std::string& file) {
    std::vector<Diagnostic> diagnostics;
    while (!log.empty()) {
        const size_t end = std::min(log.find('\n'), log.size());
        std::string_view text = log.substr(0, end);
        log.remove_prefix(std::min(end + 1, log.size()));
        const bool is_error = text.starts_with(kError);
        if ((!is_error && !text.starts_with(kWarning)) || isTotal(text)) continue;
        text.remove_prefix(is_error ? kError.size() : kWarning.size());
        Diagnostic found = {is_error ? Severity::Error : Severity::Warning, file, 0, 0, std::string(text)};
        if (splitPlace(text, found)) found.column = columnOf(lineOf(found.file, found.line), quotedIn(found.message));
        found.message = tidied(found.message);
        diagnostics.push_back(std::move(found));
    }
    return diagnostics;
}

} // namespace engine
