// Modules that are loaded from shared libraries while a program runs.
#pragma once

#include "engine/module.h"

#include <filesystem>
#include <memory>

namespace engine {

// The module of a file, which stays loaded as long as that lives. Errors: BadInput, with the file and what to do: it is not
// there, is no shared library, cannot be linked, holds no module, or one for another engine or of another build.
Result<std::unique_ptr<Module>> loadModule(const std::filesystem::path& file);

} // namespace engine
