// Scenes in which motion goes on, bounces or ends as mechanics says. What each has to fulfill stands with the scene (`brittle
// scenes NAME`).
#pragma once

#include "tests/hard/hard_case.h"

namespace hard {

void hitTheirPosts(Trial& trial, const SceneCase& self);
void keepsItsSpeed(Trial& trial, const SceneCase& self); // the first body slides
void keepsItsTops(Trial& trial, const SceneCase& self);  // parameter: from how high it falls, m
void keepTheirEnergy(Trial& trial, const SceneCase& self);
void passTheBlowOn(Trial& trial, const SceneCase& self);
void archStands(Trial& trial, const SceneCase& self);         // parameter: how far a stone may move, m
void stopWhereTheyTouch(Trial& trial, const SceneCase& self); // parameter: the speed they come with, m/s
void liesForMinutes(Trial& trial, const SceneCase& self);

} // namespace hard
