#include "tests/support/frozen_shader.h"

#include "shaders-spirv/embedded.h"

#include <gtest/gtest.h>
#include <spirv-tools/optimizer.hpp>
#include <spirv/unified1/spirv.hpp>

#include <algorithm>
#include <unordered_map>

namespace support {
namespace {

constexpr uint32_t kUnknown = ~0u;
constexpr size_t kHeaderWords = 5;

// Set, freeze and fold the constants, then leave out what nothing reaches or reads.
std::vector<uint32_t> frozen(std::span<const uint32_t> words, std::span<const engine::SpecConstant> constants) {
    std::unordered_map<uint32_t, std::vector<uint32_t>> values;
    for (const engine::SpecConstant& constant : constants)
        values[constant.id] = {constant.value};
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_1);
    optimizer.SetMessageConsumer([](spv_message_level_t level, const char*, const spv_position_t&, const char* message) {
        if (level <= SPV_MSG_ERROR) ADD_FAILURE() << message;
    });
    optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(values))
        .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
        .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
        .RegisterPass(spvtools::CreateInlineExhaustivePass())
        .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass());
    for (int round = 0; round < 2; ++round)
        optimizer.RegisterPass(spvtools::CreateSSARewritePass())
            .RegisterPass(spvtools::CreateCCPPass())
            .RegisterPass(spvtools::CreateDeadBranchElimPass())
            .RegisterPass(spvtools::CreateBlockMergePass())
            .RegisterPass(spvtools::CreateAggressiveDCEPass());
    std::vector<uint32_t> result;
    if (!optimizer.Run(words.data(), words.size(), &result)) ADD_FAILURE() << "the kernel cannot be optimized";
    return result;
}

// Where the pointer of an instruction that reads or writes memory stands; 0: none.
size_t pointerOperand(uint32_t op) {
    if (op == spv::OpStore || op == spv::OpCopyMemory || op == spv::OpAtomicStore) return 1;
    const bool is_atomic = op >= spv::OpAtomicLoad && op <= spv::OpAtomicXor;
    return op == spv::OpLoad || is_atomic ? 3 : 0;
}

} // namespace

FrozenShader::FrozenShader(std::string_view kernel, std::span<const engine::SpecConstant> constants) {
    const auto modules = shaders::all();
    const auto module = std::ranges::find(modules, kernel, &shaders::Module::name);
    if (module == modules.end()) {
        ADD_FAILURE() << "no kernel is named " << kernel;
        return;
    }
    if (auto reflection = engine::reflect(module->words)) reflection_ = std::move(*reflection);
    read(frozen(module->words, constants));
}

void FrozenShader::read(std::span<const uint32_t> words) {
    std::map<uint32_t, uint32_t> bindings, constants;
    std::map<uint32_t, Access> pointers;
    for (size_t at = kHeaderWords; at < words.size(); at += words[at] >> 16, ++instructions_) {
        const uint32_t op = words[at] & 0xffffu, length = words[at] >> 16;
        const std::span<const uint32_t> w = words.subspan(at, length);
        if (op == spv::OpDecorate && w[2] == spv::DecorationBinding) bindings[w[1]] = w[3];
        if (op == spv::OpConstant) constants[w[2]] = w[3];
        if (op == spv::OpVariable && bindings.contains(w[2])) pointers[w[2]] = {bindings[w[2]], {}, false};
        if ((op == spv::OpAccessChain || op == spv::OpInBoundsAccessChain) && pointers.contains(w[3])) {
            Access chain = pointers[w[3]];
            for (const uint32_t index : w.subspan(4))
                chain.path.push_back(constants.contains(index) ? constants[index] : kUnknown);
            pointers[w[2]] = chain;
        }
        const size_t operand = pointerOperand(op);
        if (operand == 0 || !pointers.contains(w[operand])) continue;
        accesses_.push_back(pointers[w[operand]]);
        accesses_.back().writes = op != spv::OpLoad && op != spv::OpAtomicLoad;
    }
}

uint32_t FrozenShader::bindingNamed(std::string_view name) const {
    const std::string block = std::string(name) + "_block";
    for (const engine::ReflectedBinding& binding : reflection_.bindings)
        if (binding.name == name || binding.name == block) return binding.binding;
    ADD_FAILURE() << "no binding is named " << name;
    return kUnknown;
}

uint32_t FrozenShader::memberNamed(std::string_view name) const {
    const std::string_view owner = name.substr(0, name.find('.')), member = name.substr(name.find('.') + 1);
    for (const engine::ReflectedStruct& type : reflection_.structs)
        for (size_t k = 0; k < type.members.size(); ++k)
            if (type.name == owner && type.members[k].name == member) return static_cast<uint32_t>(k);
    ADD_FAILURE() << "no member is named " << name;
    return kUnknown;
}

bool FrozenShader::stores(std::string_view binding, std::string_view member) const {
    const uint32_t slot = bindingNamed(binding), part = member.empty() ? kUnknown : memberNamed(member);
    return std::ranges::any_of(accesses_, [&](const Access& access) {
        if (!access.writes || access.binding != slot) return false;
        if (member.empty()) return true;
        // The list in the block, the element, the member, and of this the first part or all.
        const Path& path = access.path;
        return path.size() >= 3 && path[2] == part && (path.size() == 3 || path[3] == 0 || path[3] == kUnknown);
    });
}

bool FrozenShader::loads(std::string_view binding) const {
    const uint32_t slot = bindingNamed(binding);
    return std::ranges::any_of(accesses_, [&](const Access& access) { return !access.writes && access.binding == slot; });
}

} // namespace support
