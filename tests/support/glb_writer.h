// Writes a fragment file the way the exporter should, for tests of the reader; sound unless told otherwise.
#pragma once

#include "tests/reference/glb_file.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <string>

namespace support {

// `change` may spoil the JSON before it is written.
void writeFragmentFile(const std::string& path, const reference::FragmentFile& file,
                       const std::function<void(nlohmann::json&)>& change = nullptr);

} // namespace support
