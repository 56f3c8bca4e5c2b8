// The model that a command is about.
#pragma once

#include "modules/brittle/mesh/check.h"
#include "modules/brittle/mesh/repair/repair.h"

#include <nlohmann/json.hpp>

#include <string>

namespace cli {

constexpr const char* kModelHelp = "OBJ, PLY, STL, OFF, GLB, glTF, FBX or DAE file, the example vase.obj, or builtin:NAME";
constexpr const char* kRepairHelp =
    "mend what is well defined (seams, doubled triangles, orientation, small holes); refuse the rest";

// Reads a file or, if it does not exist, the example of that name. Makes a built-in model of the name after "builtin:". Errors
// of all of these begin with the name given.
engine::Result<brittle::ImportedMesh> importModel(const std::string& name);

// Prints what the reader of the file left out, a line each, on stderr.
void reportReaderNotes(const std::string& name, const std::vector<std::string>& notes);

// Prepared, not yet checked; prints the reader's notes. With `repair` mended as well, if it needs to be, and then sound for
// sure.
engine::Result<brittle::RepairedMesh> loadModel(const std::string& name, bool repair);

// What to add to a refusal: that --repair may help, where it may.
std::string adviceToRepair(const brittle::MeshReport& report);

// One line on stderr; nothing where nothing was mended.
void reportMended(const std::string& name, const brittle::RepairNotes& notes);
// Counts and places, in model space, of all that was mended.
nlohmann::ordered_json mendedJson(const brittle::RepairNotes& notes);

} // namespace cli
