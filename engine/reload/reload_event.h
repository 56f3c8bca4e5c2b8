// What a reloader has to say to a person.
#pragma once

#include "engine/reload/diagnostic.h"

#include <string>
#include <vector>

namespace engine {

struct ReloadEvent {
    enum class Kind {
        Reloaded,  // `kernels`, of which some run, are from now on as they stand in the folder
        Checked,   // `kernels`, of which none runs, are sound, and what will be run
        Unchanged, // `kernels`, of which some run, compile to what they were
        Refused,   // `kernels` are not fit, for the reasons in `diagnostics`; what was good last goes on
        Trouble,   // of another kind, in `message`
    };
    Kind kind = Kind::Trouble;
    std::vector<std::string> kernels; // in order
    std::vector<std::string> waiting; // of the same edit, sound, but not taken over without those that were refused
    std::vector<Diagnostic> diagnostics;
    std::string message;
    bool runs = false;       // somebody who is attached runs one of them
    bool at_start = false;   // of what the folder held when somebody was attached, not of something that was saved
    double compiling_ms = 0; // added up over `kernels`
    double since_save_ms = 0;
};

// By name as far as they are few.
std::string listOf(const std::vector<std::string>& kernels);
// One line, without diagnostics: "reloaded end_step, 41 ms after it was saved (compiled in 18 ms)".
std::string textOf(const ReloadEvent& event);

} // namespace engine
