// Effects that a world has not got are left out of its kernels: a constant decides, and what it leaves out vanishes from the
// pipeline, loads and stores with it. 0 is off. All effects of this kind are on where nobody says otherwise, but for the air.
#ifndef EFFECT_GLSL
#define EFFECT_GLSL
#include "shared/effects.h"

#define CONTACTS_EFFECT layout(constant_id = CONTACTS_ID) const uint kContacts = 1u
#define FRICTION_EFFECT layout(constant_id = FRICTION_ID) const uint kFriction = 1u
#define CCD_EFFECT layout(constant_id = CCD_ID) const uint kCcd = 1u
#define DRAG_EFFECT layout(constant_id = DRAG_ID) const uint kDrag = 0u

#endif
