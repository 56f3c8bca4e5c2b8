// Kernels that GPU-assisted validation leaves alone. It makes some kernels so long that a software device compiles them for
// minutes; BRITTLE_UNCHECKED_KERNELS names such kernels, separated by commas, so that a test can check all others.
//
// The layer of Debian 12 puts its checks into modules. An unchecked kernel has none: its code is passed with the pipeline,
// which VK_EXT_graphics_pipeline_library permits.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace engine {

class Device;

// Extensions that a device needs for this; empty without GPU-assisted validation, or if no kernel is named.
std::vector<std::string> extensionsForUncheckedKernels();

// False on a device that was opened without these extensions.
bool leavesUnchecked(const Device& device, std::string_view kernel);

// `list`: names, separated by commas.
bool isNamedIn(std::string_view list, std::string_view kernel);

} // namespace engine
