// Where tests find files. A check of a device runs on machines that have no source tree and says where its copies are.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace support {

inline std::filesystem::path folderFrom(const char* variable, const char* usual) {
    const char* given = std::getenv(variable);
    return given != nullptr && *given != '\0' ? given : usual;
}

// $BRITTLE_TEST_SOURCE, or the source tree that this was built from.
inline std::filesystem::path sourceFolder() { return folderFrom("BRITTLE_TEST_SOURCE", BRITTLE_SOURCE_DIR); }

} // namespace support
