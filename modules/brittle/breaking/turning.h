// Blows of bodies that turn on the way to each other: the narrow phase is asked again, with both standing as they will when
// they meet.
#pragma once

#include "modules/brittle/breaking/breaking_buffers.h"
#include "modules/brittle/dynamics/step.h"

namespace brittle {

// Of kernels that ask how bodies will meet.
struct MeetingPush {
    float gravity[4]; // w: length of a substep, s
    float duration;   // of the step, s
};
MeetingPush meetingPush(const Step& step);

// Behind find_blows, which lists them. The manifolds of the step are used up by then, and their memory is used once more.
engine::Result<void> recordTurning(const Step& step, const LastingBuffers& lasting, const PassingBuffers& passing);

} // namespace brittle
