// The page that shows results: one file, which asks nothing of a network.
#pragma once

#include "tools/accuracy/results.h"

#include <string>

namespace accuracy {

// The page of tools/accuracy/page with the results in it. Whatever the page shows stands in them.
std::string encodeReport(const Results& results);

// The useful lines as a table in Markdown.
std::string usefulTable(const Results& results);

} // namespace accuracy
