#include "modules/brittle/fracture/deciding_kernels.h"

#include "shaders-spirv/shared/fracture.h"

#include <algorithm>
#include <array>
#include <string>

namespace brittle {

engine::Result<const engine::Kernel*> kernelFor(engine::KernelLibrary& kernels, std::string_view name, uint32_t spec,
                                                Precision precision) {
    std::string in_doubles;
    if (precision != Precision::Exact) in_doubles = std::string(name) + "_double";
    // Every kernel that finds signs is there in doubles too.
    const bool decides = !in_doubles.empty() && std::ranges::count(kernels.modules(), in_doubles, &shaders::Module::name) != 0;
    if (decides && precision == Precision::Fast) {
        const std::array<uint32_t, 2> constants = {spec, PRECISION_FAST};
        static_assert(PRECISION_ID == 1);
        return kernels.get(name, constants);
    }
    return kernels.get(decides ? std::string_view(in_doubles) : name, {&spec, spec != 0 ? size_t{1} : size_t{0}});
}

} // namespace brittle
