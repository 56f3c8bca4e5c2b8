#include "engine/reflected_fields.h"

namespace engine {

namespace {

constexpr uint32_t kDeepest = 16; // no block of ours comes near; a module that refers to itself ends

std::string nameOf(const SpirvModule& module, uint32_t id) {
    const auto name = module.names.find(id);
    return name == module.names.end() ? "" : name->second;
}

std::string scalarOf(const SpirvType& type) {
    const uint32_t width = type.operands[0];
    if (type.op == spv::OpTypeFloat) return width == 64 ? "double" : width == 32 ? "float" : "float" + std::to_string(width);
    const std::string kind = type.operands.size() > 1 && type.operands[1] != 0 ? "int" : "uint";
    return width == 32 ? kind : kind + std::to_string(width);
}

// Walks down through structs and arrays to the numbers in them.
class FieldList {
public:
    explicit FieldList(const SpirvModule& module) : module_(module) {}

    struct Place {
        std::string path;    // as a shader would write it
        std::string holder;  // the struct around it
        uint32_t offset = 0; // in that struct, or in the element of an array
        std::string within;  // which array that element is of, and where this is
        uint32_t matrix_stride = 0;
        std::vector<ReflectedArray> arrays;
    };

    void addStruct(uint32_t id, const Place& place, uint32_t depth) {
        const SpirvType* type = module_.find(id);
        if (type == nullptr || type->op != spv::OpTypeStruct || depth > kDeepest) return;
        for (uint32_t m = 0; m < type->operands.size(); ++m) {
            const auto name = module_.member_names.find({id, m});
            const auto decorations = module_.member_decorations.find({id, m});
            Place member = place;
            member.path += (place.path.empty() ? "" : ".") + (name == module_.member_names.end() ? "?" : name->second);
            member.holder = nameOf(module_, id);
            if (decorations != module_.member_decorations.end()) {
                member.offset += decorations->second.get(spv::DecorationOffset);
                member.matrix_stride = decorations->second.get(spv::DecorationMatrixStride);
            }
            add(type->operands[m], member, depth + 1);
        }
    }
    std::vector<ReflectedField> take() { return std::move(fields_); }

private:
    void add(uint32_t id, const Place& place, uint32_t depth) {
        const SpirvType* type = module_.find(id);
        if (type == nullptr || type->operands.empty()) return addLeaf(nullptr, place);
        switch (type->op) {
        case spv::OpTypeStruct: return addStruct(id, place, depth);
        case spv::OpTypeArray:
        case spv::OpTypeRuntimeArray: return addArray(id, *type, place, depth);
        default: return addLeaf(type, place);
        }
    }

    void addArray(uint32_t id, const SpirvType& type, Place place, uint32_t depth) {
        const auto stride = module_.decorations.find(id);
        const uint32_t bytes = stride == module_.decorations.end() ? 0 : stride->second.get(spv::DecorationArrayStride);
        std::string count;
        ReflectedArray array = {place.offset, bytes, 0};
        if (type.op == spv::OpTypeArray && type.operands.size() > 1)
            if (const auto length = module_.constants.find(type.operands[1]); length != module_.constants.end())
                count = std::to_string(array.count = length->second) + " times ";
        place.path += "[]";
        place.within =
            " of " + count + std::to_string(bytes) + " bytes each from byte " + std::to_string(place.offset) + place.within;
        place.offset = 0;
        place.arrays.insert(place.arrays.begin(), array);
        add(type.operands[0], place, depth + 1);
    }

    std::string leafOf(const SpirvType& type, const Place& place) const {
        const SpirvType* part = partOf(type);
        if (part == nullptr || part->operands.empty() || type.operands.empty()) return "something";
        if (type.op == spv::OpTypeVector) return scalarOf(*part) + " x " + std::to_string(type.operands[1]);
        if (type.op == spv::OpTypeMatrix)
            return leafOf(*part, place) + " x " + std::to_string(type.operands[1]) + ", " +
                   std::to_string(place.matrix_stride) + " bytes apart";
        return scalarOf(type);
    }
    // Returns the type of the parts of a vector or a matrix, or the type itself if it is a number.
    const SpirvType* partOf(const SpirvType& type) const {
        return type.op == spv::OpTypeInt || type.op == spv::OpTypeFloat ? &type : module_.find(type.operands[0]);
    }
    static bool isNumber(const SpirvType& type) {
        return (type.op == spv::OpTypeInt || type.op == spv::OpTypeFloat) && !type.operands.empty();
    }

    void setNumbers(const SpirvType& type, ReflectedField& field) const {
        if (isNumber(type)) {
            field.scalar = scalarOf(type);
            return;
        }
        if ((type.op != spv::OpTypeVector && type.op != spv::OpTypeMatrix) || type.operands.size() < 2) return;
        (type.op == spv::OpTypeVector ? field.rows : field.columns) = type.operands[1];
        if (const SpirvType* part = partOf(type)) setNumbers(*part, field);
    }

    void addLeaf(const SpirvType* type, const Place& place) {
        const std::string name = type == nullptr || type->operands.empty() ? "something" : leafOf(*type, place);
        ReflectedField field = {place.path, place.holder, name + " at byte " + std::to_string(place.offset) + place.within};
        if (name != "something") setNumbers(*type, field);
        field.matrix_stride = place.matrix_stride;
        field.offset = place.offset;
        field.arrays = place.arrays;
        fields_.push_back(std::move(field));
    }

    const SpirvModule& module_;
    std::vector<ReflectedField> fields_;
};

} // namespace

std::vector<ReflectedField> fieldsOf(const SpirvModule& module, uint32_t id) {
    FieldList list(module);
    list.addStruct(id, {}, 0);
    return list.take();
}

} // namespace engine
