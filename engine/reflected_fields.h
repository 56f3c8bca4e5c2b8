// What a block of a shader holds, number by number.
#pragma once

#include "engine/reflection.h"
#include "engine/spirv_module.h"

namespace engine {

// Of the struct with this id, in the order of its declaration; empty for what is no struct.
std::vector<ReflectedField> fieldsOf(const SpirvModule& module, uint32_t id);

} // namespace engine
