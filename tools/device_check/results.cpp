#include "tools/device_check/results.h"

#include "modules/brittle/export/output_file.h"

#include <cstdio>

namespace device_check {
namespace {

bool writeFile(const std::filesystem::path& path, const std::string& text, bool& told) {
    auto file = brittle::OutputFile::create(path);
    engine::Result<void> done = file ? file->write(text) : engine::Result<void>(file.error());
    if (done) done = file->commit();
    if (done) return true;
    if (!told) std::fprintf(stderr, "brittle: %s; what was written before stays\n", done.error().message.c_str());
    told = true;
    return false;
}

} // namespace

void Results::add(const std::string& name, const Json& outcome) {
    json_["parts"][name] = outcome;
    write();
}

void Results::write() {
    const bool has_json = writeFile(folder_ / "results.json", json_.dump(1) + "\n", told_json_);
    const bool has_page = writeFile(folder_ / "results.html", pageOf(json_), told_page_);
    written_ = has_json && has_page;
}

} // namespace device_check
