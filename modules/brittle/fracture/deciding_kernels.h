// Kernels as a precision wants them: those that find signs take it from a specialization constant, or are modules of their own.
#pragma once

#include "engine/kernel.h"
#include "modules/brittle/fracture/precision.h"

#include <string_view>

namespace brittle {

// `spec` is the value of constant 0, 0 where the kernel has none.
engine::Result<const engine::Kernel*> kernelFor(engine::KernelLibrary& kernels, std::string_view name, uint32_t spec,
                                                Precision precision);

} // namespace brittle
