#include "tools/brittle/unknown_word.h"

#include "modules/brittle/scene/nearest_name.h"

#include <algorithm>

namespace cli {
namespace {

std::vector<std::string> namesOfSubcommands(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    return names;
}

// "--sites" and "-o", as they are typed.
std::vector<std::string> namesOfOptions(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
        for (const std::string& name : option->get_snames())
            names.push_back("-" + name);
    }
    return names;
}

bool isOneOf(const std::vector<std::string>& names, std::string_view word) {
    return std::ranges::find(names, word) != names.end();
}

std::string meant(std::string_view word, const std::vector<std::string>& names, const std::string& otherwise) {
    const std::vector<std::string_view> known(names.begin(), names.end());
    return brittle::didYouMean(word, known, otherwise);
}

std::string aboutOptions(const CLI::App& command, const std::string& name, std::span<const char* const> words) {
    const std::vector<std::string> options = namesOfOptions(command);
    for (const char* text : words) {
        const std::string_view word = std::string_view(text).substr(0, std::string_view(text).find('='));
        if (word == "--") return ""; // what follows are names of files
        if (!word.starts_with("--") || isOneOf(options, word)) continue;
        const std::string help = "; " + name + " --help lists its options";
        return name + " has no option " + brittle::inQuotes(word) + meant(word, options, help);
    }
    return "";
}

} // namespace

std::string aboutUnknownWord(const CLI::App& app, std::span<const char* const> words) {
    const std::string list = "; " + app.get_name() + " --help lists them";
    if (words.empty()) return "no subcommand is given" + list;
    const std::string first = words[0];
    const std::vector<std::string> commands = namesOfSubcommands(app);
    if (isOneOf(commands, first))
        return aboutOptions(*app.get_subcommand(first), app.get_name() + " " + first, words.subspan(1));
    if (first.starts_with('-')) return aboutOptions(app, app.get_name(), words.first(1));
    return "there is no subcommand " + brittle::inQuotes(first) + meant(first, commands, list);
}

} // namespace cli
