#include "tools/accuracy/program_version.h"

#include "tools/accuracy/version.h"

namespace accuracy {

ProgramVersion programVersion() { return {BRITTLE_VERSION, BRITTLE_COMMIT, BRITTLE_COMPILER}; }

} // namespace accuracy
