// The files that results are left in, which are there all or not at all.
#pragma once

#include "modules/brittle/export/output_file.h"
#include "tools/accuracy/results.h"
#include "tools/brittle/interrupt.h"

#include <filesystem>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace accuracy {

struct ResultFile {
    const char* name;
    std::string (*encode)(const Results& results);
};
extern const ResultFile kResultsFile, kTableFile, kPageFile;

class ResultFiles {
public:
    // Makes the folder where there is none. Before anything is measured, since that takes minutes. Errors: BadInput, for what
    // cannot be written.
    engine::Result<void> open(const std::filesystem::path& folder, std::initializer_list<ResultFile> kinds);
    engine::Result<void> write(const Results& results);

private:
    cli::OutputFolder folder_; // outlives what was begun in it
    std::vector<std::pair<ResultFile, brittle::OutputFile>> files_;
};

} // namespace accuracy
