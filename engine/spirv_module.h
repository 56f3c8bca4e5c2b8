// The instructions of a SPIR-V module that say what it looks like from outside, by id.
#pragma once

#include "engine/result.h"

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <spirv/unified1/spirv.hpp>
#include <string>
#include <utility>
#include <vector>

namespace engine {

struct SpirvType {
    spv::Op op = spv::OpNop;
    std::vector<uint32_t> operands; // after the result id
};

struct SpirvVariable {
    uint32_t id = 0, pointer_type = 0;
    spv::StorageClass storage = spv::StorageClassMax;
};

struct SpirvDecorations {
    std::map<uint32_t, uint32_t> values; // decoration to its first operand
    bool has(spv::Decoration d) const { return values.contains(d); }
    uint32_t get(spv::Decoration d) const {
        const auto found = values.find(d);
        return found == values.end() ? 0 : found->second;
    }
};

// One pass over the words collects what the questions below need.
struct SpirvModule {
    std::map<uint32_t, std::string> names;
    std::map<std::pair<uint32_t, uint32_t>, std::string> member_names;
    std::map<uint32_t, SpirvDecorations> decorations;
    std::map<std::pair<uint32_t, uint32_t>, SpirvDecorations> member_decorations;
    std::map<uint32_t, SpirvType> types;
    std::map<uint32_t, uint32_t> constants;             // by id, specialization constants with their defaults
    std::map<uint32_t, std::vector<uint32_t>> reckoned; // from specialization constants: operation and operands
    std::map<uint32_t, std::vector<uint32_t>> composites;
    std::vector<SpirvVariable> variables;
    std::vector<uint32_t> capabilities; // spv::Capability
    std::array<uint32_t, 3> local_size = {1, 1, 1};
    spv::ExecutionModel model = spv::ExecutionModelMax;

    void instruction(spv::Op op, std::span<const uint32_t> w);
    void type(spv::Op op, std::span<const uint32_t> w);
    uint32_t sizeOf(uint32_t id, uint32_t matrix_stride) const;
    uint32_t structSize(uint32_t id) const;
    const SpirvType* find(uint32_t id) const;
    bool allMembersHave(uint32_t id, spv::Decoration decoration) const;
};

// Errors: BadInput for words that are none.
Result<SpirvModule> parseSpirv(std::span<const uint32_t> words);

} // namespace engine
