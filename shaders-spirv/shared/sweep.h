// Contacts are looked for a little further ahead than a step, since a body may be faster by its end than it is now. Shared with
// C++.
#ifndef SWEEP_H
#define SWEEP_H

#define SWEEP_AHEAD 1.25 /* steps */

#endif
