// The bench's inputs as the module takes them.
#pragma once

#include "modules/brittle/fracture/fracture.h"
#include "modules/brittle/mesh/prepare.h"
#include "tools/bench/bench.h"
#include "tools/bench/inputs.h"

#include <initializer_list>
#include <string_view>

namespace bench {

engine::Result<brittle::PreparedMesh> prepared(const Model& model);

// Device time of the named stages, added up.
double stageMs(const brittle::FractureResult& result, std::initializer_list<std::string_view> stages);

// Medians of every kernel over this many runs of their own; the largest first.
engine::Result<Times> kernelTimes(brittle::Fracture& fracture, const brittle::PreparedMesh& model,
                                  brittle::FractureOptions options, uint32_t rounds);

} // namespace bench
