#include "modules/brittle/dynamics/narrow_phase.h"

#include "shaders-spirv/shared/contact.h"
#include "shaders-spirv/shared/narrow_phase.h"

#include <array>
#include <cmath>
#include <string>

namespace brittle {
namespace {

using engine::Error;
using engine::ErrorCode;
using engine::Kernel;
using engine::Result;

Result<void> checkOptions(const NarrowPhaseOptions& options) {
    const auto refuse = [](const std::string& what) { return Error{ErrorCode::BadInput, "narrow phase: " + what}; };
    if (!(options.speculative >= 0) || !std::isfinite(options.speculative))
        return refuse("the speculative distance is " + std::to_string(options.speculative) + " m; give one of 0 or more");
    if (!(options.duration >= 0) || !std::isfinite(options.duration))
        return refuse("the step takes " + std::to_string(options.duration) + " s; give it 0 or more");
    if (!(options.step >= 0 && options.strip >= 0) || !std::isfinite(options.step) || !std::isfinite(options.strip))
        return refuse("steps of " + std::to_string(options.step) + " s and strips of " + std::to_string(options.strip) +
                      " m; give both as 0 or more");
    for (const uint32_t known : {0u, 6u, 14u, 26u, 62u})
        if (options.fixed_axes == known) return {};
    return refuse("there are no " + std::to_string(options.fixed_axes) + " fixed axes; take 6, 14, 26, 62, or 0 for all");
}

Result<void> checkRoom(const NarrowPhaseInput& input, const NarrowPhaseOutput& output) {
    const auto room = [&](const char* name, const engine::BufferView& view, uint64_t needed) -> Result<void> {
        if (view.size >= needed) return {};
        return Error{ErrorCode::Capacity, std::string("narrow phase: ") + name + " has " + std::to_string(view.size) + " of " +
                                              std::to_string(needed) + " bytes for " + std::to_string(input.capacity) +
                                              " pairs; make it larger"};
    };
    const uint64_t pairs = input.capacity;
    if (auto fits = room("counts", input.counts, 4 * (uint64_t{input.count_at} + 1)); !fits) return fits;
    if (auto fits = room("pairs", input.pairs, pairs * 8); !fits) return fits;
    if (auto fits = room("manifolds", output.manifolds, pairs * sizeof(gpu::Manifold)); !fits) return fits;
    if (auto fits = room("axes", output.axes, pairs * sizeof(gpu::AxisRecord)); !fits) return fits;
    return room("arguments", output.arguments, kNarrowPhaseArgumentBytes);
}

struct Kernels {
    const Kernel* size;
    const Kernel* axes;
    const Kernel* first_hits;
    const Kernel* manifolds;
};

Result<Kernels> kernelsOf(engine::KernelLibrary& library, uint32_t fixed_axes, bool many_lanes) {
    const auto size = library.get("size_narrow_phase");
    if (!size) return size.error();
    const auto axes = library.get(fixed_axes > 0 ? "find_fixed_axes" : many_lanes ? "find_axes_wide" : "find_axes");
    if (!axes) return axes.error();
    const auto first_hits = library.get("name_first_hits");
    if (!first_hits) return first_hits.error();
    const auto manifolds = library.get("build_manifolds");
    if (!manifolds) return manifolds.error();
    return Kernels{*size, *axes, *first_hits, *manifolds};
}

Result<void> recordSiblings(engine::Commands& commands, engine::KernelLibrary& library, const NarrowPhaseInput& input,
                            const gpu::NarrowPhasePush& push, const NarrowPhaseOutput& output) {
    const auto kernel = library.get("separate_siblings");
    if (!kernel) return kernel.error();
    commands.dispatchIndirect(**kernel, output.arguments.sub(16, 12), push,
                              {input.counts, input.pairs, input.pieces, input.bodies, input.hulls.records, input.hulls.vertices,
                               input.hulls.faces, input.siblings->births, input.siblings->steps, output.axes});
    return {};
}

} // namespace

Result<void> recordNarrowPhase(engine::Commands& commands, engine::KernelLibrary& library, const NarrowPhaseInput& input,
                               const NarrowPhaseOptions& options, const NarrowPhaseOutput& output, bool many_lanes) {
    if (auto valid = checkOptions(options); !valid) return valid;
    if (auto fits = checkRoom(input, output); !fits) return fits;
    const auto kernels = kernelsOf(library, options.fixed_axes, many_lanes);
    if (!kernels) return kernels.error();

    const Float3& g = options.gravity;
    const gpu::NarrowPhasePush push = {{g[0], g[1], g[2], 0}, options.speculative, options.duration,
                                       input.capacity,        input.count_at,      options.fixed_axes,
                                       options.step,          options.strip,       input.first_hits ? 1u : 0u};
    const engine::BufferView first_hits = input.first_hits.value_or(output.arguments); // of which nothing is read or written then
    const HullPools& hulls = input.hulls;
    commands.dispatchGroups(*kernels->size, 1, push, {input.counts, output.arguments});
    if (input.siblings)
        if (auto recorded = recordSiblings(commands, library, input, push, output); !recorded) return recorded;
    commands.dispatchIndirect(*kernels->axes, output.arguments.sub(0, 12), push,
                              {input.counts, input.pairs, input.pieces, input.bodies, hulls.records, hulls.vertices,
                               hulls.faces, hulls.corners, hulls.edges, output.axes, first_hits});
    if (input.first_hits)
        commands.dispatchIndirect(*kernels->first_hits, output.arguments.sub(16, 12), push,
                                  {input.counts, input.pairs, input.pieces, input.bodies, output.axes, first_hits});
    commands.dispatchIndirect(*kernels->manifolds, output.arguments.sub(16, 12), push,
                              {input.counts, input.pairs, input.pieces, input.bodies, hulls.records, hulls.vertices,
                               hulls.faces, hulls.corners, hulls.edges, output.axes, output.manifolds, first_hits});
    return commands.status();
}

} // namespace brittle
