// Example scenes and models, which come with the program. Commands find them by name, from any folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cli {

// The example of this name, such as "window_pane.toml" or "vase.obj". Empty if it does not exist, or if `name` leads into a
// folder.
//
// Examples of an installed program are in share/brittle/examples, beside the folder of the program. Those of a build are in its
// source tree.
std::filesystem::path exampleFile(const std::string& name);

// All that end in `extension`, such as ".toml", in the order of their names.
std::vector<std::filesystem::path> exampleFiles(const std::string& extension);

} // namespace cli
