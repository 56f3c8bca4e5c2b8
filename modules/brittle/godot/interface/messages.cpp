#include "modules/brittle/godot/interface/messages.h"

#include "modules/brittle/godot/interface/host.h"

namespace brittle_godot {
namespace {

// The engine shows a place in the code with each message; ours says nothing to a user of the plugin.
constexpr const char* kWho = "Brittle";

} // namespace

void tellError(const std::string& message) {
    host().print_error_with_message(message.c_str(), message.c_str(), kWho, "brittle", 0, 0);
}

void tellWarning(const std::string& message) {
    host().print_warning_with_message(message.c_str(), message.c_str(), kWho, "brittle", 0, 0);
}

} // namespace brittle_godot
