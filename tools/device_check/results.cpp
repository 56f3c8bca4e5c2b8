#include "tools/device_check/results.h"

#include "tools/brittle/interrupt.h"

#include <cstdio>

namespace device_check {
namespace {

bool writeFile(const std::filesystem::path& path, const std::string& text, bool& told) {
    auto file = cli::createOutput(path);
    engine::Result<void> done = file ? file->write(text) : engine::Result<void>(file.error());
    if (done) done = file->commit();
    if (done) return true;
    if (!told) std::fprintf(stderr, "brittle: %s; the earlier file stays\n", done.error().message.c_str());
    told = true;
    return false;
}

} // namespace

void Results::add(const std::string& name, const Json& outcome) {
    json_["parts"][name] = outcome;
    write();
}

std::string textOf(const Json& json, int indent) { return json.dump(indent, ' ', false, Json::error_handler_t::replace); }

// Paths are hidden in the text, where they stand in messages of all kinds.
std::string Results::shown(int indent) const {
    std::string text = textOf(json_, indent);
    for (const auto& [path, word] : hidden_)
        for (size_t at = path.empty() ? std::string::npos : text.find(path); at != std::string::npos;
             at = text.find(path, at + word.size()))
            text.replace(at, path.size(), word);
    return text;
}

void Results::write() {
    const bool has_json = writeFile(folder_ / "results.json", shown(1) + "\n", told_json_);
    const bool has_page = writeFile(folder_ / "results.html", pageOf(shown(-1)), told_page_);
    written_ = has_json && has_page;
}

} // namespace device_check
