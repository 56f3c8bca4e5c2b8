// Moves a scene at another size (scaled_scene.h) and gives back its bodies at the size of the scene as it is described. So
// the checks of a hard case and their limits judge any size without a change.
//
//   scene, contents            as described            what the checks read
//        | scaled(S)
//   scaled scene, contents     times S                 what the inner mover moves
//        | states
//   places / S, velocities / root S, spins * root S, angular momenta / S^4.5
#pragma once

#include "tests/support/mover.h"

namespace support {

// `scale`: above 0. `make_inner` makes the mover of the scaled scene; without one it is a Brittle world on the device. The
// device outlives what is made. Errors: those of fracture, of contents, and of the inner mover; Device, if the device cannot
// run Brittle.
MakeMover scaledMover(engine::Device& device, double scale, MakeMover make_inner = {});

} // namespace support
