// One lock for all that passes through the Vulkan loader's lists of instances and devices.
#pragma once

#include <mutex>

namespace engine {

// Held while instances and devices are made, unmade and asked for their functions: loaders walk their lists of devices without
// a lock (1.3.239 reads freed memory there), and volk keeps what it finds in globals. What a host makes and unmakes itself is
// the host's to keep apart.
std::mutex& loaderMutex();

} // namespace engine
