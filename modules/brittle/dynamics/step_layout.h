// Lays out what is made anew in every step.
#pragma once

#include "modules/brittle/dynamics/world_buffers.h"

namespace brittle {

// Takes `b.step` from the arena, by b.sizes and b.broad_phase, and adds the names to `b.named`. What no effect asks for is the
// dummy. Errors: those of the broad phase, no room in the arena.
engine::Result<void> layOutStep(engine::ScratchArena& arena, const engine::BufferView& dummy, WorldBuffers& b);

} // namespace brittle
