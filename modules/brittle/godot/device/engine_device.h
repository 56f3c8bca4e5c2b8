// The Vulkan device that the engine draws with.
#pragma once

#include "modules/brittle/brittle.h"

#include <optional>
#include <string>

namespace brittle_godot {

// Where the engine draws with a RenderingDevice, on its render thread. Nothing, and why, where that is not to be used. The
// handles are the engine's, and its queue may be used on that thread alone.
std::optional<BrittleVulkan> engineVulkan(std::string& why);

} // namespace brittle_godot
