// Kernels as a precision wants them: those that find signs take it from a specialization constant, or are modules of their own.
#pragma once

#include "engine/kernel.h"
#include "modules/brittle/fracture/precision.h"

#include <string_view>

namespace brittle {

// Finds the version of kernel `name` for a precision; on a device without subgroup votes, NAME_no_vote if there is one.
// `spec` is the value of constant 0, or 0 if the kernel has none. Errors: those of KernelLibrary::get.
engine::Result<const engine::Kernel*> kernelFor(engine::KernelLibrary& kernels, std::string_view name, uint32_t spec,
                                                Precision precision);

} // namespace brittle
