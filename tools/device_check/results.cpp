#include "tools/device_check/results.h"

#include "tools/brittle/interrupt.h"
#include "tools/device_check/check_summary.h"

#include <cstdio>

namespace device_check {
namespace {

bool writeFile(const std::filesystem::path& path, const std::string& text, bool& told) {
    auto file = cli::createOutput(path);
    engine::Result<void> done = file ? file->write(text) : engine::Result<void>(file.error());
    if (done) done = file->commit();
    if (done) return true;
    std::error_code unknown;
    const char* earlier = std::filesystem::exists(path, unknown) ? "; the earlier file stays" : "";
    if (!told) std::fprintf(stderr, "brittle: %s%s\n", done.error().message.c_str(), earlier);
    told = true;
    return false;
}

// Keeps a file under a second name, or as a copy on file systems that have no second names. Leaves no half of a copy.
bool keepAs(const std::filesystem::path& file, const std::filesystem::path& name, std::error_code& failed) {
    std::filesystem::create_hard_link(file, name, failed);
    if (!failed || std::filesystem::copy_file(file, name, failed)) return true;
    std::error_code ignored;
    std::filesystem::remove(name, ignored);
    return false;
}

} // namespace

void Results::add(const std::string& name, const Json& outcome) {
    json_["parts"][name] = outcome;
    json_["unchecked"] = uncheckedIn(json_["parts"]);
    write();
}

std::string textOf(const Json& json, int indent) { return json.dump(indent, ' ', false, Json::error_handler_t::replace); }

// Paths stand in messages of all kinds. They are replaced before JSON changes quotes and backslashes in them.
void Results::hidePaths(Json& json) const {
    if (json.is_structured())
        for (Json& member : json)
            hidePaths(member);
    if (!json.is_string()) return;
    auto& text = json.get_ref<std::string&>();
    for (const auto& [path, word] : hidden_)
        for (size_t at = path.empty() ? std::string::npos : text.find(path); at != std::string::npos;
             at = text.find(path, at + word.size()))
            text.replace(at, path.size(), word);
}

std::string Results::shown(int indent) const {
    Json json = json_;
    hidePaths(json);
    return textOf(json, indent);
}

// The file keeps its name as well: if the new one cannot be written, the earlier one is still there.
engine::Result<std::vector<std::string>> Results::keepEarlier() {
    std::vector<std::string> kept;
    for (const char* name : {"results.json", "results.html"}) {
        std::error_code failed;
        if (!std::filesystem::exists(folder_ / name, failed)) continue;
        int number = 1;
        while (std::filesystem::exists(folder_ / (name + ("." + std::to_string(number))), failed))
            ++number;
        const std::string copy = name + ("." + std::to_string(number));
        if (!keepAs(folder_ / name, folder_ / copy, failed))
            return engine::Error{engine::ErrorCode::BadInput, (folder_ / name).string() +
                                                                  ": is of an earlier check and cannot be kept (" +
                                                                  failed.message() + "); give another folder with -o"};
        kept.push_back(copy);
    }
    return kept;
}

void Results::write() {
    const bool has_json = writeFile(folder_ / "results.json", shown(1) + "\n", told_json_);
    const bool has_page = writeFile(folder_ / "results.html", pageOf(shown(-1)), told_page_);
    written_ = has_json && has_page;
}

} // namespace device_check
