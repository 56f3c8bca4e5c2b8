#include "tools/accuracy/result_files.h"

#include "tools/accuracy/report.h"

namespace accuracy {

using engine::Result;

const ResultFile kResultsFile = {"results.json", encodeResults}, kTableFile = {"results.csv", encodeCsv},
                 kPageFile = {"report.html", encodeReport};

Result<void> ResultFiles::open(const std::filesystem::path& folder, std::initializer_list<ResultFile> kinds) {
    auto made = cli::OutputFolder::create(folder);
    if (!made) return made.error();
    folder_ = std::move(*made);
    for (const ResultFile& kind : kinds) {
        auto file = cli::createOutput((folder / kind.name).string());
        if (!file) return file.error();
        files_.emplace_back(kind, std::move(*file));
    }
    return {};
}

Result<void> ResultFiles::write(const Results& results) {
    for (auto& [kind, file] : files_)
        if (auto written = file.write(kind.encode(results)); !written) return written;
    for (auto& [kind, file] : files_)
        if (auto committed = file.commit(); !committed) return committed;
    return {};
}

} // namespace accuracy
