// Which `brittle` this is.
#pragma once

namespace accuracy {

struct ProgramVersion {
    const char* version;
    const char* commit;
    const char* compiler; // with its version, and what it was asked for
};
ProgramVersion programVersion();

} // namespace accuracy
