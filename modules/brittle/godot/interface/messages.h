// What users read in the engine's output and debugger.
#pragma once

#include <string>

namespace brittle_godot {

void tellError(const std::string& message);
void tellWarning(const std::string& message);

} // namespace brittle_godot
