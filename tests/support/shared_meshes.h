// Models that are not part of the project: tests that need them skip, visibly, where they are not at hand.
#pragma once

#include "tests/support/folders.h"
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace support {

// $BRITTLE_SHARED, or the folder `shared` beside the project.
inline std::filesystem::path sharedFolder() {
    if (const char* given = std::getenv("BRITTLE_SHARED")) return given;
    return sourceFolder() / ".." / "shared";
}

inline std::filesystem::path sharedMesh(const std::string& name) { return sharedFolder() / "meshes" / name; }

} // namespace support

#define SKIP_WITHOUT_MESHES()                                                                                                  \
    if (!std::filesystem::exists(support::sharedFolder() / "meshes")) GTEST_SKIP() << "no models in " << support::sharedFolder()
