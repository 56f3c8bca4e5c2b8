// Where in a source, or in what it includes, its interface is declared, so that an error about it can say so.
#pragma once

#include "engine/kernel_interface.h"
#include "engine/reload/diagnostic.h"
#include "engine/reload/glsl_compiler.h"

namespace engine {

// An error of each change, at the declaration that has changed: of a struct whose members lie elsewhere, at the struct; of what
// is gone, at what is left of its kind before it, or at main().
std::vector<Diagnostic> placeChanges(const std::vector<InterfaceChange>& changes, const KernelSource& source,
                                     const std::vector<std::filesystem::path>& include_folders);

} // namespace engine
