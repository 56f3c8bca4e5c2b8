#include "engine/reflection.h"

#include <algorithm>
#include <map>
#include <spirv/unified1/spirv.hpp>
#include <string_view>

namespace engine {

namespace {

constexpr size_t kHeaderWords = 5;

struct Type {
    spv::Op op = spv::OpNop;
    std::vector<uint32_t> operands; // after the result id
};

struct Variable {
    uint32_t id = 0, pointer_type = 0;
    spv::StorageClass storage = spv::StorageClassMax;
};

struct Decorations {
    std::map<uint32_t, uint32_t> values; // decoration to its first operand
    bool has(spv::Decoration d) const { return values.contains(d); }
    uint32_t get(spv::Decoration d) const {
        const auto found = values.find(d);
        return found == values.end() ? 0 : found->second;
    }
};

// One pass over the words collects what the questions below need.
struct Parsed {
    std::map<uint32_t, std::string> names;
    std::map<std::pair<uint32_t, uint32_t>, std::string> member_names;
    std::map<uint32_t, Decorations> decorations;
    std::map<std::pair<uint32_t, uint32_t>, Decorations> member_decorations;
    std::map<uint32_t, Type> types;
    std::map<uint32_t, uint32_t> constants; // by id, specialization constants with their defaults
    std::map<uint32_t, std::vector<uint32_t>> composites;
    std::vector<Variable> variables;
    std::array<uint32_t, 3> local_size = {1, 1, 1};
    spv::ExecutionModel model = spv::ExecutionModelMax;

    void instruction(spv::Op op, std::span<const uint32_t> w);
    void type(spv::Op op, std::span<const uint32_t> w);
    uint32_t sizeOf(uint32_t id, uint32_t matrix_stride) const;
    uint32_t structSize(uint32_t id) const;
    const Type* find(uint32_t id) const;
    bool allMembersHave(uint32_t id, spv::Decoration decoration) const;
};

std::string text(std::span<const uint32_t> words) {
    std::string result;
    for (const uint32_t word : words) {
        for (uint32_t shift = 0; shift < 32; shift += 8) {
            const char c = static_cast<char>(word >> shift & 0xffu);
            if (c == 0) return result;
            result += c;
        }
    }
    return result;
}

// `w` is the instruction without its first word, and at least two words long for all that is looked at here.
void Parsed::instruction(spv::Op op, std::span<const uint32_t> w) {
    switch (op) {
    case spv::OpEntryPoint: model = static_cast<spv::ExecutionModel>(w[0]); break;
    case spv::OpExecutionMode:
        if (w[1] == spv::ExecutionModeLocalSize && w.size() >= 5) local_size = {w[2], w[3], w[4]};
        break;
    case spv::OpName: names[w[0]] = text(w.subspan(1)); break;
    case spv::OpMemberName: member_names[{w[0], w[1]}] = text(w.subspan(2)); break;
    case spv::OpDecorate: decorations[w[0]].values[w[1]] = w.size() > 2 ? w[2] : 0; break;
    case spv::OpMemberDecorate:
        if (w.size() > 2) member_decorations[{w[0], w[1]}].values[w[2]] = w.size() > 3 ? w[3] : 0;
        break;
    case spv::OpConstant:
    case spv::OpSpecConstant:
        if (w.size() > 2) constants[w[1]] = w[2];
        break;
    case spv::OpConstantComposite:
    case spv::OpSpecConstantComposite: composites[w[1]] = {w.begin() + 2, w.end()}; break;
    case spv::OpVariable:
        if (w.size() > 2) variables.push_back({w[1], w[0], static_cast<spv::StorageClass>(w[2])});
        break;
    default: type(op, w);
    }
}

void Parsed::type(spv::Op op, std::span<const uint32_t> w) {
    switch (op) {
    case spv::OpTypeInt:
    case spv::OpTypeFloat:
    case spv::OpTypeVector:
    case spv::OpTypeMatrix:
    case spv::OpTypeArray:
    case spv::OpTypeRuntimeArray:
    case spv::OpTypeStruct:
    case spv::OpTypePointer: types[w[0]] = {op, {w.begin() + 1, w.end()}}; break;
    default: break;
    }
}

const Type* Parsed::find(uint32_t id) const {
    const auto found = types.find(id);
    return found == types.end() ? nullptr : &found->second;
}

uint32_t Parsed::sizeOf(uint32_t id, uint32_t matrix_stride) const {
    const Type* t = find(id);
    if (t == nullptr || t->operands.empty()) return 0;
    const auto& o = t->operands;
    switch (t->op) {
    case spv::OpTypeInt:
    case spv::OpTypeFloat: return o[0] / 8;
    case spv::OpTypeVector: return o[1] * sizeOf(o[0], 0);
    case spv::OpTypeMatrix: return o[1] * matrix_stride;
    case spv::OpTypeArray: {
        const auto length = constants.find(o[1]);
        const auto stride = decorations.find(id);
        if (length == constants.end() || stride == decorations.end()) return 0;
        return length->second * stride->second.get(spv::DecorationArrayStride);
    }
    case spv::OpTypeStruct: return structSize(id);
    default: return 0;
    }
}

uint32_t Parsed::structSize(uint32_t id) const {
    uint32_t size = 0;
    const auto& members = types.at(id).operands;
    for (uint32_t m = 0; m < members.size(); ++m) {
        const auto found = member_decorations.find({id, m});
        if (found == member_decorations.end()) continue;
        const uint32_t stride = found->second.get(spv::DecorationMatrixStride);
        size = std::max(size, found->second.get(spv::DecorationOffset) + sizeOf(members[m], stride));
    }
    return size;
}

bool Parsed::allMembersHave(uint32_t id, spv::Decoration decoration) const {
    const Type* t = find(id);
    if (t == nullptr || t->op != spv::OpTypeStruct || t->operands.empty()) return false;
    for (uint32_t m = 0; m < t->operands.size(); ++m) {
        const auto found = member_decorations.find({id, m});
        if (found == member_decorations.end() || !found->second.has(decoration)) return false;
    }
    return true;
}

ReflectedBinding bindingOf(const Parsed& parsed, const Variable& variable, uint32_t block, const Decorations& decorations) {
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
    return binding;
}

void addVariables(const Parsed& parsed, Reflection& result) {
    for (const Variable& variable : parsed.variables) {
        const Type* pointer = parsed.find(variable.pointer_type);
        if (pointer == nullptr || pointer->operands.size() < 2) continue;
        const uint32_t pointee = pointer->operands[1];
        if (variable.storage == spv::StorageClassPushConstant && parsed.types.contains(pointee)) {
            result.push_size = parsed.structSize(pointee);
        }
        const auto decorations = parsed.decorations.find(variable.id);
        if (decorations == parsed.decorations.end() || !decorations->second.has(spv::DecorationBinding)) continue;
        result.bindings.push_back(bindingOf(parsed, variable, pointee, decorations->second));
    }
    std::ranges::sort(result.bindings, {}, [](const ReflectedBinding& b) { return std::pair(b.set, b.binding); });
}

// glslang leaves an undecorated copy of every struct that is also a local variable: those have no layout and are left out.
void addStructs(const Parsed& parsed, Reflection& result) {
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
void setLocalSize(const Parsed& parsed, Reflection& result) {
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

void addSpecConstants(const Parsed& parsed, Reflection& result) {
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
    if (words.size() < kHeaderWords || words[0] != spv::MagicNumber) {
        return Error{ErrorCode::BadInput, "not a SPIR-V module of this machine's byte order"};
    }
    Parsed parsed;
    for (size_t at = kHeaderWords; at < words.size();) {
        const size_t length = words[at] >> 16;
        if (length == 0 || at + length > words.size()) return Error{ErrorCode::BadInput, "a SPIR-V module that ends early"};
        if (length >= 3) parsed.instruction(static_cast<spv::Op>(words[at] & 0xffffu), words.subspan(at + 1, length - 1));
        at += length;
    }
    Reflection result;
    result.stage = stageOf(parsed.model);
    setLocalSize(parsed, result);
    addVariables(parsed, result);
    addStructs(parsed, result);
    addSpecConstants(parsed, result);
    return result;
}

} // namespace engine
