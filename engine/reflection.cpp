#include "engine/reflection.h"

#include "engine/reflected_fields.h"
#include "engine/spirv_module.h"

#include <algorithm>
#include <map>
#include <spirv/unified1/spirv.hpp>
#include <string_view>

namespace engine {

namespace {

ReflectedBinding bindingOf(const SpirvModule& parsed, const SpirvVariable& variable, uint32_t block,
                           const SpirvDecorations& decorations) {
    ReflectedBinding binding;
    binding.set = decorations.get(spv::DecorationDescriptorSet);
    binding.binding = decorations.get(spv::DecorationBinding);
    binding.storage_buffer = variable.storage == spv::StorageClassStorageBuffer;
    const auto own = parsed.names.find(variable.id), type = parsed.names.find(block);
    if (own != parsed.names.end() && !own->second.empty())
        binding.name = own->second;
    else if (type != parsed.names.end())
        binding.name = type->second;
    const auto declared = [&](spv::Decoration d) { return decorations.has(d) || parsed.allMembersHave(block, d); };
    binding.readonly = declared(spv::DecorationNonWritable);
    binding.writeonly = declared(spv::DecorationNonReadable);
    binding.fields = fieldsOf(parsed, block);
    return binding;
}

void addVariables(const SpirvModule& parsed, Reflection& result) {
    for (const SpirvVariable& variable : parsed.variables) {
        const SpirvType* pointer = parsed.find(variable.pointer_type);
        if (pointer == nullptr || pointer->operands.size() < 2) continue;
        const uint32_t pointee = pointer->operands[1];
        if (variable.storage == spv::StorageClassPushConstant && parsed.types.contains(pointee)) {
            result.push_size = parsed.structSize(pointee);
            result.push_fields = fieldsOf(parsed, pointee);
        }
        const auto decorations = parsed.decorations.find(variable.id);
        if (decorations == parsed.decorations.end() || !decorations->second.has(spv::DecorationBinding)) continue;
        result.bindings.push_back(bindingOf(parsed, variable, pointee, decorations->second));
    }
    std::ranges::sort(result.bindings, {}, [](const ReflectedBinding& b) { return std::pair(b.set, b.binding); });
}

// glslang leaves an undecorated copy of every struct that is also a local variable: those have no layout and are left out.
void addStructs(const SpirvModule& parsed, Reflection& result) {
    for (const auto& [id, type] : parsed.types) {
        const auto first = parsed.member_decorations.find({id, 0});
        if (type.op != spv::OpTypeStruct || first == parsed.member_decorations.end()) continue;
        if (!first->second.has(spv::DecorationOffset)) continue;
        ReflectedStruct found;
        if (const auto name = parsed.names.find(id); name != parsed.names.end()) found.name = name->second;
        for (uint32_t m = 0; m < type.operands.size(); ++m) {
            const auto name = parsed.member_names.find({id, m});
            const auto offset = parsed.member_decorations.find({id, m});
            if (name == parsed.member_names.end() || offset == parsed.member_decorations.end()) continue;
            found.members.push_back({name->second, offset->second.get(spv::DecorationOffset)});
        }
        for (const auto& [array, array_type] : parsed.types) {
            const bool is_array = array_type.op == spv::OpTypeArray || array_type.op == spv::OpTypeRuntimeArray;
            const auto stride = parsed.decorations.find(array);
            if (!is_array || array_type.operands[0] != id || stride == parsed.decorations.end()) continue;
            found.array_stride = std::max(found.array_stride, stride->second.get(spv::DecorationArrayStride));
        }
        result.structs.push_back(std::move(found));
    }
}

// A constant decorated as WorkgroupSize holds in place of the execution mode; its parts may be specialization constants.
void setLocalSize(const SpirvModule& parsed, Reflection& result) {
    result.local_size = parsed.local_size;
    for (const auto& [id, parts] : parsed.composites) {
        const auto own = parsed.decorations.find(id);
        if (own == parsed.decorations.end() || !own->second.has(spv::DecorationBuiltIn)) continue;
        if (own->second.get(spv::DecorationBuiltIn) != spv::BuiltInWorkgroupSize || parts.size() != 3) continue;
        for (size_t k = 0; k < 3; ++k) {
            if (const auto size = parsed.constants.find(parts[k]); size != parsed.constants.end())
                result.local_size[k] = size->second;
            const auto part = parsed.decorations.find(parts[k]);
            if (part != parsed.decorations.end() && part->second.has(spv::DecorationSpecId))
                result.local_size_ids[k] = part->second.get(spv::DecorationSpecId);
        }
    }
}

void addSpecConstants(const SpirvModule& parsed, Reflection& result) {
    std::map<uint32_t, std::string> names; // by constant_id; several may have the same
    for (const auto& [id, decorations] : parsed.decorations) {
        if (!decorations.has(spv::DecorationSpecId)) continue;
        std::string& name = names[decorations.get(spv::DecorationSpecId)];
        if (const auto own = parsed.names.find(id); own != parsed.names.end()) name = own->second;
    }
    for (const auto& [id, name] : names) {
        result.spec_ids.push_back(id);
        result.spec_names.push_back(name);
    }
}

ShaderStage stageOf(spv::ExecutionModel model) {
    switch (model) {
    case spv::ExecutionModelGLCompute: return ShaderStage::Compute;
    case spv::ExecutionModelVertex: return ShaderStage::Vertex;
    case spv::ExecutionModelFragment: return ShaderStage::Fragment;
    default: return ShaderStage::Other;
    }
}

} // namespace

Result<Reflection> reflect(std::span<const uint32_t> words) {
    const auto parsed = parseSpirv(words);
    if (!parsed) return parsed.error();
    Reflection result;
    result.stage = stageOf(parsed->model);
    result.capabilities = parsed->capabilities;
    setLocalSize(*parsed, result);
    addVariables(*parsed, result);
    addStructs(*parsed, result);
    addSpecConstants(*parsed, result);
    return result;
}

} // namespace engine
