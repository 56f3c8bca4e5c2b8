// Whether two paths lead to the same file.
#pragma once

#include <string>

namespace cli {

// By whatever names: links and detours are followed. An empty name is no file.
bool sameFile(const std::string& a, const std::string& b);

} // namespace cli
