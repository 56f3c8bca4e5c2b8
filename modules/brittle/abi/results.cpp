#include "modules/brittle/brittle.h"

static_assert(sizeof(void*) == 8, "the C ABI is one for 64 bits");

uint32_t brittleVersion(void) { return BRITTLE_VERSION; }

const char* brittleResultName(BrittleResult result) {
    switch (result) {
    case BRITTLE_OK: return "BRITTLE_OK";
    case BRITTLE_NULL_ARGUMENT: return "BRITTLE_NULL_ARGUMENT";
    case BRITTLE_WRONG_VERSION: return "BRITTLE_WRONG_VERSION";
    case BRITTLE_WRONG_HANDLE: return "BRITTLE_WRONG_HANDLE";
    case BRITTLE_STALE_HANDLE: return "BRITTLE_STALE_HANDLE";
    case BRITTLE_BAD_VALUE: return "BRITTLE_BAD_VALUE";
    case BRITTLE_BAD_MESH: return "BRITTLE_BAD_MESH";
    case BRITTLE_BAD_STATE: return "BRITTLE_BAD_STATE";
    case BRITTLE_WRONG_ORDER: return "BRITTLE_WRONG_ORDER";
    case BRITTLE_CAPACITY: return "BRITTLE_CAPACITY";
    case BRITTLE_BUFFER_TOO_SMALL: return "BRITTLE_BUFFER_TOO_SMALL";
    case BRITTLE_OUT_OF_MEMORY: return "BRITTLE_OUT_OF_MEMORY";
    case BRITTLE_MISSING_FEATURE: return "BRITTLE_MISSING_FEATURE";
    case BRITTLE_DEVICE_FAILED: return "BRITTLE_DEVICE_FAILED";
    case BRITTLE_INTERNAL: return "BRITTLE_INTERNAL";
    }
    return "BRITTLE_UNKNOWN_RESULT";
}
