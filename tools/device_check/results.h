// Keeps the findings of a check in two files: results.json for programs, results.html for people.
#pragma once

#include "engine/result.h"
#include "tools/device_check/kit.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace device_check {

class Results {
public:
    // `hidden`: paths, and the words that stand for them in the files. So results can be sent without names of users.
    using Hidden = std::vector<std::pair<std::string, std::string>>;
    explicit Results(std::filesystem::path folder, Hidden hidden = {})
        : folder_(std::move(folder)), hidden_(std::move(hidden)) {}

    Json& json() { return json_; }
    // Adds a part's outcome, or replaces it if there is one of that name, and writes both files. They name what is unchecked by
    // then.
    void add(const std::string& name, const Json& outcome);
    // Writes both files beside their places and moves them there, so that an interrupted write leaves the earlier ones whole.
    // If a file cannot be written, one line on standard error says why, once for each file; the check goes on.
    void write();
    bool wasWritten() const { return written_; }
    const std::filesystem::path& folder() const { return folder_; }

    // Gives the files of an earlier check a second name with the next free number, results.json.1. Returns these names.
    // Errors: BadInput if a copy cannot be written.
    engine::Result<std::vector<std::string>> keepEarlier();

private:
    void hidePaths(Json& json) const;
    std::string shown(int indent) const;

    std::filesystem::path folder_;
    Hidden hidden_;
    Json json_ = Json::object();
    bool written_ = false;
    bool told_json_ = false, told_page_ = false;
};

// Returns JSON text on one line, or with `indent` spaces per level. Bytes that are no UTF-8, as of messages cut in a character,
// are replaced.
std::string textOf(const Json& json, int indent = -1);

// One self-contained page with tables and plots of these results, which are JSON text.
std::string pageOf(const std::string& results);

} // namespace device_check
