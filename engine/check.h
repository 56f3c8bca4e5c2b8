// Assertions: for bugs of ours, never for what the world may hand us.
#pragma once

#include <cstdio>
#include <cstdlib>

// On in every build unless ENGINE_NO_ASSERTS is defined: none stands in a hot loop.
#ifdef ENGINE_NO_ASSERTS
#define ENGINE_ASSERT(condition) ((void)0)
#else
#define ENGINE_ASSERT(condition)                                                                                               \
    do {                                                                                                                       \
        if (!(condition)) {                                                                                                    \
            std::fprintf(stderr, "%s:%d: assertion failed: %s\n", __FILE__, __LINE__, #condition);                             \
            std::abort();                                                                                                      \
        }                                                                                                                      \
    } while (false)
#endif
