// The engine that has loaded the plugin: its functions, and the library that we are to it. There is one in a process, from the
// entry function until the plugin is let go.
#pragma once

#include "modules/brittle/godot/interface/gdextension.h"

#include <string>
#include <type_traits>

namespace brittle_godot {

struct Host {
    void* library = nullptr;
#define BRITTLE_GODOT_FIELD(name, type) std::add_pointer_t<type> name = nullptr;
    BRITTLE_GODOT_FUNCTIONS(BRITTLE_GODOT_FIELD)
#undef BRITTLE_GODOT_FIELD
};

const Host& host();

// False where the engine lacks functions; then `missing` names them, and nothing else of the plugin may be used.
bool meetHost(GetProcAddress get_proc_address, void* library, std::string& missing);

} // namespace brittle_godot
