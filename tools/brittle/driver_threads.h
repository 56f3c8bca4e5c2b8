// How many threads Mesa's software device may start.
#pragma once

namespace cli {

// Asks lavapipe for two threads a core, at most the 16 it knows, unless LP_NUM_THREADS says otherwise. It parts a dispatch
// evenly among its threads once and for all: with one a core, a dispatch lasts twice as long whenever both find themselves on
// one core, which the system's scheduler lets happen for whole runs. Other devices never look. To be called before any other
// thread is started, since it changes the environment.
void spreadDriverThreads();

} // namespace cli
