// Which specialization constants switch effects, beside those of shared/fracture.h.
#ifndef EFFECTS_H
#define EFFECTS_H

#define CONTACTS_ID 10 /* 0: off */
#define FRICTION_ID 11
#define CCD_ID 12
#define DRAG_ID 13 /* the bits of a float: half of density times coefficient times pi, kg/m3; 0: off */

#define SIBLINGS_ID 14 /* 1: axes of fragments that have just come apart may be known before they are looked for */

#endif
