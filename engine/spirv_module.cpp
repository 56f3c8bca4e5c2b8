#include "engine/spirv_module.h"

#include <algorithm>

namespace engine {

namespace {

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

} // namespace

// `w` is the instruction without its first word, and at least two words long for all that is looked at here.
void SpirvModule::instruction(spv::Op op, std::span<const uint32_t> w) {
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
    case spv::OpSpecConstantOp: reckoned[w[1]] = {w.begin() + 2, w.end()}; break;
    case spv::OpConstantComposite:
    case spv::OpSpecConstantComposite: composites[w[1]] = {w.begin() + 2, w.end()}; break;
    case spv::OpVariable:
        if (w.size() > 2) variables.push_back({w[1], w[0], static_cast<spv::StorageClass>(w[2])});
        break;
    default: type(op, w);
    }
}

void SpirvModule::type(spv::Op op, std::span<const uint32_t> w) {
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

const SpirvType* SpirvModule::find(uint32_t id) const {
    const auto found = types.find(id);
    return found == types.end() ? nullptr : &found->second;
}

uint32_t SpirvModule::sizeOf(uint32_t id, uint32_t matrix_stride) const {
    const SpirvType* t = find(id);
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

uint32_t SpirvModule::structSize(uint32_t id) const {
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

bool SpirvModule::allMembersHave(uint32_t id, spv::Decoration decoration) const {
    const SpirvType* t = find(id);
    if (t == nullptr || t->op != spv::OpTypeStruct || t->operands.empty()) return false;
    for (uint32_t m = 0; m < t->operands.size(); ++m) {
        const auto found = member_decorations.find({id, m});
        if (found == member_decorations.end() || !found->second.has(decoration)) return false;
    }
    return true;
}

Result<SpirvModule> parseSpirv(std::span<const uint32_t> words) {
    constexpr size_t kHeaderWords = 5;
    if (words.size() < kHeaderWords || words[0] != spv::MagicNumber)
        return Error{ErrorCode::BadInput, "not a SPIR-V module of this machine's byte order"};
    SpirvModule parsed;
    for (size_t at = kHeaderWords; at < words.size();) {
        const size_t length = words[at] >> 16;
        if (length == 0 || at + length > words.size()) return Error{ErrorCode::BadInput, "a SPIR-V module that ends early"};
        const auto op = static_cast<spv::Op>(words[at] & 0xffffu);
        if (op == spv::OpCapability && length == 2) parsed.capabilities.push_back(words[at + 1]);
        if (length >= 3) parsed.instruction(op, words.subspan(at + 1, length - 1));
        at += length;
    }
    return parsed;
}

} // namespace engine
