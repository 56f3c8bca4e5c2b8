#include "modules/brittle/fracture/deciding_kernels.h"

#include "shaders-spirv/shared/fracture.h"

#include <algorithm>
#include <array>
#include <string>

namespace brittle {

namespace {

bool hasModule(const engine::KernelLibrary& kernels, std::string_view name) {
    return std::ranges::count(kernels.modules(), name, &shaders::Module::name) != 0;
}

// The variant of a kernel for devices without subgroup votes, if it uses them.
std::string withoutVote(const engine::KernelLibrary& kernels, std::string_view name) {
    const std::string variant = std::string(name) + "_no_vote";
    return !kernels.deviceFeatures().subgroup_vote && hasModule(kernels, variant) ? variant : std::string(name);
}

} // namespace

engine::Result<const engine::Kernel*> kernelFor(engine::KernelLibrary& kernels, std::string_view name, uint32_t spec,
                                                Precision precision) {
    const std::string base = withoutVote(kernels, name), in_doubles = base + "_double";
    // Every kernel that finds signs is there in doubles too.
    const bool decides = precision != Precision::Exact && hasModule(kernels, in_doubles);
    if (decides && precision == Precision::Fast) {
        const std::array<uint32_t, 2> constants = {spec, PRECISION_FAST};
        static_assert(PRECISION_ID == 1);
        return kernels.get(base, constants);
    }
    return kernels.get(decides ? in_doubles : base, {&spec, spec != 0 ? size_t{1} : size_t{0}});
}

} // namespace brittle
