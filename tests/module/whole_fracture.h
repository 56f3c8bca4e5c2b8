// Whole fractures against the contract, as an outsider sees it: the exported file, read back by the checker's own reader, and
// the model, read by the checker's own reader.
#pragma once

#include "modules/brittle/fracture/fracture.h"
#include "modules/brittle/mesh/import.h"
#include "modules/brittle/mesh/prepare.h"
#include "tests/reference/geometry.h"

#include <array>
#include <initializer_list>
#include <map>
#include <set>
#include <string>

namespace whole {

// One for all tests of the program, so that pipelines are made once.
brittle::Fracture& fracture();

struct Model {
    brittle::PreparedMesh prepared;
    reference::Triangles triangles; // as the checker sees them
};

Model modelFrom(const brittle::ImportedMesh& imported);
// "builtin:NAME", or a model of the shared folder, which the checker reads by itself.
Model modelFrom(const std::string& name);
brittle::ImportedMesh boxOf(const brittle::Double3& lower, const brittle::Double3& upper);

// A fragment, to be broken again.
Model modelFrom(const brittle::FragmentSet& set, size_t fragment);

void expectContract(const Model& model, const brittle::FractureOptions& options);
void expectContract(const Model& model, const brittle::FractureResult& result);
// The same with sites placed by the pattern, so many at a time.
void expectContractOf(const Model& model, std::initializer_list<uint32_t> site_counts);
// Of sites given by hand.
void expectContractAt(const Model& model, const std::vector<brittle::Double3>& sites);

// Of every cell, all places of corners of its fragments, bit for bit.
std::map<uint32_t, std::set<std::array<float, 3>>> placesByCell(const brittle::FractureResult& result);

} // namespace whole
