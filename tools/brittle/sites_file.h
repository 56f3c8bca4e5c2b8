// Sites given by hand.
#pragma once

#include "engine/result.h"
#include "modules/brittle/mesh/mesh.h"

#include <string>
#include <vector>

namespace cli {

// Reads text with one site a line, `x y z` in model space; # begins a comment. `name`: a file, or an example. Errors: BadInput, with
// the line.
engine::Result<std::vector<brittle::Double3>> readSitesFile(const std::string& name);

} // namespace cli
