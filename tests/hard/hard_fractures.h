// Breaks that are hard: sites in ties, sites that crowd, models that are thin, tiny, huge, far away or made of slivers, and
// fragments of fragments. What each has to fulfill is the contract of fragments (tests/reference/contract.h), at exact
// precision; at less it may be broken, and how badly is what is measured.
#pragma once

#include "modules/brittle/fracture/fracture.h"
#include "modules/brittle/mesh/import.h"
#include "tests/hard/hard_case.h"

namespace hard {

struct FractureCase {
    std::string name;
    brittle::ImportedMesh (*model)(double parameter) = nullptr;
    double parameter = 0;                // of the model
    std::vector<brittle::Double3> sites; // none: the pattern's
    uint32_t site_count = 0;             // of the pattern
    uint32_t depth = 1;                  // the largest fragment is broken again, so often in all
};

// Those of the 27 site sets in their boxes first.
std::vector<FractureCase> fractureCases();

struct FractureCost {
    double ms = 0;          // on the device, of all breaks
    double exact_tests = 0; // cells that were cut again by exact signs
};

FractureCost measureFracture(Trial& trial, brittle::Fracture& fracture, const FractureCase& self, brittle::Precision precision);

} // namespace hard
