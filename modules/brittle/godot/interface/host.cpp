#include "modules/brittle/godot/interface/host.h"

namespace brittle_godot {
namespace {

Host the_host;

template <class Function>
void find(GetProcAddress get_proc_address, const char* name, Function*& function, std::string& missing) {
    function = reinterpret_cast<Function*>(get_proc_address(name));
    if (function == nullptr) missing += (missing.empty() ? "" : ", ") + std::string(name);
}

} // namespace

const Host& host() { return the_host; }

bool meetHost(GetProcAddress get_proc_address, void* library, std::string& missing) {
    the_host.library = library;
#define BRITTLE_GODOT_FIND(name, type) find(get_proc_address, #name, the_host.name, missing);
    BRITTLE_GODOT_FUNCTIONS(BRITTLE_GODOT_FIND)
#undef BRITTLE_GODOT_FIND
    return missing.empty();
}

} // namespace brittle_godot
