// Says what is going on: on a terminal in one line that is rewritten, else in a line every ten seconds.
#pragma once

#include <string>

namespace cli {

void showProgress(const std::string& what);
void clearProgress();

} // namespace cli
