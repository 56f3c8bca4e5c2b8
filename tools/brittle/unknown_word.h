// Answers a word on the command line that the program does not know.
#pragma once

#include <CLI/CLI.hpp>

#include <span>
#include <string>

namespace cli {

// Finds the first word that `app` does not know: a subcommand, or an option of the subcommand that comes first. Returns a
// sentence about it, with the nearest word that is known, or "" if there is none. `words`: the command line without the name of
// the program.
std::string aboutUnknownWord(const CLI::App& app, std::span<const char* const> words);

} // namespace cli
