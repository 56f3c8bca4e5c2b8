// Meshes that bound no solid, and files of nothing: each has to be refused with words that say what is wrong.
#pragma once

#include "modules/brittle/mesh/import.h"
#include "tests/hard/hard_case.h"

namespace hard {

struct MeshCase {
    const char* name;
    brittle::ImportedMesh (*make)();
    const char* says; // a part of the refusal
};

std::span<const MeshCase> meshCases();
void measureMesh(Trial& trial, const MeshCase& self);

} // namespace hard
