// What a scan adds up: single words, or four counters of one thing at a time.
#ifndef CHANNELS
#define CHANNELS 1
#endif
#if CHANNELS == 4
#define Value uvec4
#else
#define Value uint
#endif
