// Sums up the parts of a check at its end.
#pragma once

#include "tools/device_check/kit.h"

#include <string>

namespace device_check {

// One sentence about the parts that did nothing or not all of their work. Empty if none did.
std::string uncheckedIn(const Json& parts);

// A full disk fails all kinds of work: drivers that cannot write to their cache end with a bus error. So a part that failed on
// a full disk counts as stopped, unless it found differing values. `folder`: on that disk.
void excuseFullDisk(Json& outcome, const std::filesystem::path& folder);

// Free bytes on the disk of a folder; 0 if the system does not tell.
uint64_t freeBytes(const std::filesystem::path& folder);

} // namespace device_check
