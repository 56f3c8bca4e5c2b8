// One line on the terminal that says what is going on. Silent where stderr is no terminal.
#pragma once

#include <string>

namespace cli {

void showProgress(const std::string& what);
void clearProgress();

} // namespace cli
