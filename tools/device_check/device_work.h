// Work of a check that runs in a process of its own. Each function prints one JSON object per line as soon as it is known, so
// that nothing is lost if the process is ended. The first line is {"of": how many others there are in all}.
#pragma once

#include "tools/device_check/kit.h"

#include "engine/device.h"

namespace device_check {

constexpr uint32_t kSiteCounts[] = {10, 100, 1000};

// Breaks each model of the kit at each of kSiteCounts: {"model", "sites", "fragments", "topology", "positions", "attributes",
// "masses", "violation", "ms"}; hashes are 16 hexadecimal digits (modules/brittle/fracture/fingerprint.h). A model that cannot
// be broken gives {"model", "sites", "error"}.
void fingerprintModels(engine::Device& device, const Kit& kit);

// Simulates the first seconds of each scene twice, or with `once` one time, whose hash then stands for both: {"scene",
// "seconds", "hashes": [first, second], "bodies", "fragments", "median_ms"} or {"scene", "error"}. Scenes are the built-in ones
// and the examples of the kit.
void simulateScenes(engine::Device& device, const Kit& kit, double seconds, bool once);

// Steps a scene in which nothing happens, with and without breaking: {"breaking", "median_ms", "dispatches", "stages"}.
void measureIdleSteps(engine::Device& device, const Kit& kit);

} // namespace device_check
