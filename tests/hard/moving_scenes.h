// Scenes in which something flies, spins, slides or bounces, and those that are compared with each other or with a reference.
#pragma once

#include "tests/hard/hard_case.h"

namespace hard {

void spinsFreely(Trial& trial, const SceneCase& self);
void stopsAtTheWall(Trial& trial, const SceneCase& self); // parameter: speed, m/s
void pushesThePlate(Trial& trial, const SceneCase& self);
void bouncesBack(Trial& trial, const SceneCase& self);
void holdsOnTheSlope(Trial& trial, const SceneCase& self);
void slidesDownTheSlope(Trial& trial, const SceneCase& self);
void bounces(Trial& trial, const SceneCase& self); // parameter: height after it, m
void implodes(Trial& trial, const SceneCase& self);
void movesAlikeFarAway(Trial& trial, const SceneCase& self);
void findsAllPairs(Trial& trial, const SceneCase& self);
void isTheSameHoweverMade(Trial& trial, const SceneCase& self);
void movesAsTheReference(Trial& trial, const SceneCase& self);
void weighsAlike(Trial& trial, const SceneCase& self);
void scalesAlike(Trial& trial, const SceneCase& self);
void movesAlikeAtEveryScale(Trial& trial, const SceneCase& self);
void casesMoveAlikeAtEveryScale(Trial& trial, const SceneCase& self);

} // namespace hard
