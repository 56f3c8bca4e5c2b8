// Scenes in which all should stand, lie or come to rest. What each has to fulfill stands with the scene (`brittle scenes
// NAME`).
#pragma once

#include "tests/hard/hard_case.h"

namespace hard {

void staysAtRest(Trial& trial, const SceneCase& self);
void standsOnOneCorner(Trial& trial, const SceneCase& self); // the standing block
void comesApartGently(Trial& trial, const SceneCase& self);
void grownCellsStaySlow(Trial& trial, const SceneCase& self); // parameter: 1 where it is known not to
void stackStands(Trial& trial, const SceneCase& self);        // parameter: how far aside the top may go, m
void lightCarriesHeavy(Trial& trial, const SceneCase& self);  // parameter: how deep they may lie in each other, m
void cardsStand(Trial& trial, const SceneCase& self);
void liesFlat(Trial& trial, const SceneCase& self);    // parameter: thickness, m
void sliversRest(Trial& trial, const SceneCase& self); // parameter: thickness, m
void pileSettles(Trial& trial, const SceneCase& self);
void pilesComeToRest(Trial& trial, const SceneCase& self);
void largePileSettles(Trial& trial, const SceneCase& self);
void slabHoldsAll(Trial& trial, const SceneCase& self);
void allSleep(Trial& trial, const SceneCase& self);
void hardlyCreeps(Trial& trial, const SceneCase& self);
void towerStands(Trial& trial, const SceneCase& self); // cubes on each other, none asleep
void heavyStands(Trial& trial, const SceneCase& self); // the second body, on the first
void tinyBodiesRest(Trial& trial, const SceneCase& self);

} // namespace hard
