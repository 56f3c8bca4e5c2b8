// Brings the outcome of an event to the host: counts and status first, then just as much of the pools as was used.
#pragma once

#include "modules/brittle/fracture/event.h"

namespace brittle {

// Fills fragments, sites and counts of `result`; returns the words of counts and status.
engine::Result<std::vector<uint32_t>> readBack(engine::Device& device, const Mesh& mesh, const EventGrid& grid,
                                               const FractureOptions& options, const EventBuffers& b, const ScenePools& scene,
                                               FractureResult& result, std::vector<uint32_t>& site_tiles);

// Of the sites used, how many have fragments and how many have none.
void countFilledCells(FractureResult& result);

// An event that finished, but not well: what went wrong, for the user.
engine::Result<void> checkStatus(const std::vector<uint32_t>& status);

} // namespace brittle
