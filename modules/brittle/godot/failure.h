// What cannot be done, in words for the user of the plugin.
#pragma once

#include <stdexcept>

namespace brittle_godot {

class Failure : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

} // namespace brittle_godot
