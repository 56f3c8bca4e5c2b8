// Scenes that ask for more than there is room for, and those that a world must refuse: nothing else may suffer from it.
#pragma once

#include "tests/hard/hard_case.h"

namespace hard {

void overflowLosesNothing(Trial& trial, const SceneCase& self);
void isRefused(Trial& trial, const SceneCase& self); // all scenes of the case's number

} // namespace hard
