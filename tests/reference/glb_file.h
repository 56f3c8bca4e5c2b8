// Reads back a GLB of fragments: just enough of glTF 2.0 for that, and suspicious of everything.
#pragma once

#include "tests/reference/geometry.h"

#include <cstdint>
#include <string>
#include <vector>

namespace reference {

struct Piece {
    std::string name;
    Point translation = {0, 0, 0}; // of its node: where the fragment's frame lies in model space
    Point site = {0, 0, 0};        // model space
    uint32_t cell = 0;
    double volume = 0; // as the file claims it
    Triangles outer;   // in the fragment's frame
    Triangles inner;
};

struct FragmentFile {
    std::vector<Piece> pieces;
    std::vector<std::string> faults; // in form: names, extras, materials, normals, accessor bounds
};

// Throws std::runtime_error where the file cannot be read at all.
FragmentFile readFragmentFile(const std::string& path);

} // namespace reference
