#include "engine/kernel_storage.h"

#include "engine/spirv_module.h"

#include <algorithm>
#include <optional>

namespace engine {
namespace {

constexpr uint64_t kEndless = uint64_t{1} << 40; // bytes; more is as bad

// Sizes of types that lie in no buffer, so that nothing in the module tells their layout.
class TypeSizes {
public:
    TypeSizes(const SpirvModule& parsed, std::span<const SpecConstant> constants) : parsed_(parsed), constants_(constants) {}

    uint64_t sizeOf(uint32_t id) const {
        const SpirvType* t = parsed_.find(id);
        if (t == nullptr || t->operands.empty()) return 4; // bool
        const auto& o = t->operands;
        switch (t->op) {
        case spv::OpTypeInt:
        case spv::OpTypeFloat: return o[0] / 8;
        case spv::OpTypeVector: return times(o[1] == 3 ? 4 : o[1], sizeOf(o[0]));
        case spv::OpTypeMatrix: return times(o[1], sizeOf(o[0]));
        case spv::OpTypeArray: return times(valueOf(o[1]).value_or(1), sizeOf(o[0]));
        case spv::OpTypeStruct: return structSize(o);
        default: return 0; // pointers and what is opaque
        }
    }

private:
    static uint64_t times(uint64_t count, uint64_t size) {
        return size != 0 && count > kEndless / size ? kEndless : count * size;
    }

    uint64_t structSize(const std::vector<uint32_t>& members) const {
        uint64_t size = 0;
        for (const uint32_t member : members)
            size = std::min(kEndless, size + sizeOf(member));
        return size;
    }

    // None where it is reckoned in a way that lengths of arrays are not.
    std::optional<uint32_t> valueOf(uint32_t id) const {
        if (const auto own = parsed_.decorations.find(id);
            own != parsed_.decorations.end() && own->second.has(spv::DecorationSpecId)) {
            const auto set = std::ranges::find(constants_, own->second.get(spv::DecorationSpecId), &SpecConstant::id);
            if (set != constants_.end()) return set->value;
        }
        if (const auto constant = parsed_.constants.find(id); constant != parsed_.constants.end()) return constant->second;
        const auto reckoned = parsed_.reckoned.find(id);
        if (reckoned == parsed_.reckoned.end() || reckoned->second.size() != 3) return std::nullopt;
        const auto a = valueOf(reckoned->second[1]), b = valueOf(reckoned->second[2]);
        return a && b ? reckon(static_cast<spv::Op>(reckoned->second[0]), *a, *b) : std::nullopt;
    }

    static std::optional<uint32_t> reckon(spv::Op op, uint32_t a, uint32_t b) {
        switch (op) {
        case spv::OpIAdd: return a + b;
        case spv::OpISub: return a - b;
        case spv::OpIMul: return a * b;
        case spv::OpUDiv:
        case spv::OpSDiv: return b == 0 ? std::nullopt : std::optional(a / b);
        case spv::OpShiftLeftLogical: return b < 32 ? std::optional(a << b) : std::nullopt;
        case spv::OpShiftRightLogical: return b < 32 ? std::optional(a >> b) : std::nullopt;
        default: return std::nullopt;
        }
    }

    const SpirvModule& parsed_;
    std::span<const SpecConstant> constants_;
};

void add(KernelStorage::Part& part, uint64_t bytes, const std::string& name) {
    part.bytes = std::min(kEndless, part.bytes + bytes);
    if (bytes <= part.largest_bytes) return;
    part.largest_bytes = bytes;
    part.largest = name;
}

} // namespace

KernelStorage storageOf(std::span<const uint32_t> words, std::span<const SpecConstant> constants) {
    const auto parsed = parseSpirv(words);
    if (!parsed) return {};
    const TypeSizes sizes(*parsed, constants);
    KernelStorage storage;
    for (const SpirvVariable& variable : parsed->variables) {
        const SpirvType* pointer = parsed->find(variable.pointer_type);
        if (pointer == nullptr || pointer->operands.size() < 2) continue;
        const bool is_shared = variable.storage == spv::StorageClassWorkgroup;
        if (!is_shared && variable.storage != spv::StorageClassFunction && variable.storage != spv::StorageClassPrivate)
            continue;
        const auto name = parsed->names.find(variable.id);
        add(is_shared ? storage.shared : storage.lane, (sizes.sizeOf(pointer->operands[1]) + 3) / 4 * 4,
            name == parsed->names.end() ? "" : name->second);
    }
    return storage;
}

} // namespace engine
