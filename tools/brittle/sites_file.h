// Sites given by hand.
#pragma once

#include "engine/result.h"
#include "modules/brittle/mesh/mesh.h"

#include <string>
#include <vector>

namespace cli {

// Text, one site a line as `x y z` in model space, # begins a comment. BadInput, with the line, for anything else.
engine::Result<std::vector<brittle::Double3>> readSitesFile(const std::string& path);

} // namespace cli
