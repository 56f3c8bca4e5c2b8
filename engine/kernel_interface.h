// What a host and a kernel have to agree on, and where another version of the kernel does not.
#pragma once

#include "engine/reflection.h"

#include <string>
#include <vector>

namespace engine {

struct InterfaceChange {
    enum class Of { Stage, Binding, PushConstants, Constant, GroupSize };
    Of of = Of::Stage;
    uint32_t set = 0, index = 0; // of a binding; the constant_id of a constant
    std::string holder;          // the struct whose members lie elsewhere now, where it is one
    std::string why;
};

// `host` is what the host was built with. Buffers have to be the same ones, of the same layout, read and written alike; push
// constants and specialization constants the same; workgroups of the same size. Names do not count, and a kernel that has no
// more use for its push constants may leave them out. Empty: it will do.
std::vector<InterfaceChange> interfaceChanges(const Reflection& host, const Reflection& now);

} // namespace engine
