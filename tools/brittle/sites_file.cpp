#include "tools/brittle/sites_file.h"

#include "modules/brittle/mesh/text_reader.h"
#include "tools/brittle/example_files.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace cli {
namespace {

constexpr uint64_t kMostBytes = 1ull << 30;
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

} // namespace

engine::Result<std::vector<brittle::Double3>> readSitesFile(const std::string& name) {
    const std::filesystem::path example = std::filesystem::exists(name) ? std::filesystem::path() : exampleFile(name);
    const std::string path = example.empty() ? name : example.string();
    const auto bad = [&](const std::string& message) {
        return engine::Error{engine::ErrorCode::BadInput, path + ": " + message};
    };
    std::error_code unreadable;
    const std::filesystem::file_status status = std::filesystem::status(path, unreadable);
    if (!std::filesystem::exists(status)) return bad("cannot be opened; check the name");
    if (!std::filesystem::is_regular_file(status)) return bad("not a file; give the name of a text file with a site a line");
    if (std::filesystem::file_size(path, unreadable) > kMostBytes) return bad("larger than 1 GiB; leave sites out");
    std::ifstream file(path, std::ios::binary);
    if (!file) return bad("cannot be opened; check the name");
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    if (file.bad()) return bad("cannot be read; is it a file?");
    std::vector<brittle::Double3> sites;
    brittle::TextReader text(std::string_view(bytes).substr(bytes.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0));
    for (std::string_view line = text.nextFullLine(); !line.empty(); line = text.nextFullLine()) {
        const auto badLine = [&](const char* what) { return bad("line " + std::to_string(text.line()) + ": " + what); };
        brittle::Words words(line);
        brittle::Double3& site = sites.emplace_back();
        for (double& coordinate : site) {
            const auto number = words.nextNumber();
            if (!number) return badLine("a site needs three numbers: x y z");
            if (!std::isfinite(*number)) return badLine("a coordinate is not a finite number; mend or remove the line");
            coordinate = *number;
        }
        if (!words.next().empty()) return badLine("more than three numbers; one site a line");
    }
    if (sites.empty()) return bad("no sites in it; write one a line as x y z");
    return sites;
}

} // namespace cli
