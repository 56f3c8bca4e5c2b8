// What a SPIR-V module says about itself: bindings, push block, workgroup size, specialization constants, struct layouts.
#pragma once

#include "engine/result.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace engine {

// An array that a field lies in.
struct ReflectedArray {
    uint32_t first = 0;  // byte of the first element in the element of the next array outside, or in the block
    uint32_t stride = 0; // bytes from one element to the next
    uint32_t count = 0;  // 0: as many as the buffer holds
};

// A number, vector or matrix in a block, however deep in arrays and structs of it.
struct ReflectedField {
    std::string path;   // "bodies[].offset"
    std::string holder; // the struct that it is a member of
    std::string layout; // type and place in words: equal only where host and shader mean the same bytes
    std::string scalar; // type of one number: "float", "uint64"; empty if the field is no number, vector or matrix
    uint32_t rows = 1, columns = 1;     // of a vector `rows` numbers, of a matrix `columns` vectors
    uint32_t matrix_stride = 0;         // bytes from column to column
    uint32_t offset = 0;                // bytes, in the element of the innermost array, or in the block
    std::vector<ReflectedArray> arrays; // from the innermost to the outermost
};

struct ReflectedBinding {
    uint32_t set = 0;
    uint32_t binding = 0;
    std::string name;
    bool storage_buffer = false; // false: anything else
    bool readonly = false;
    bool writeonly = false;
    std::vector<ReflectedField> fields; // of a block, in order
};

struct ReflectedMember {
    std::string name;
    uint32_t offset = 0;
};

// A struct with explicit offsets; array_stride is 0 where no array of it stands in the module.
struct ReflectedStruct {
    std::string name;
    std::vector<ReflectedMember> members;
    uint32_t array_stride = 0;
};

enum class ShaderStage { Compute, Vertex, Fragment, Other };

struct Reflection {
    ShaderStage stage = ShaderStage::Other;
    std::vector<ReflectedBinding> bindings; // by set and binding
    uint32_t push_size = 0;                 // bytes up to the end of the last member
    std::vector<ReflectedField> push_fields;
    std::array<uint32_t, 3> local_size = {1, 1, 1};        // where nothing is specialized
    std::array<std::optional<uint32_t>, 3> local_size_ids; // constant_ids that set it
    std::vector<uint32_t> spec_ids;                        // ascending
    std::vector<std::string> spec_names;                   // of these; empty for what has none
    std::vector<ReflectedStruct> structs;
    std::vector<uint32_t> capabilities; // numbers of SPIR-V capabilities, as declared
};

Result<Reflection> reflect(std::span<const uint32_t> words);

} // namespace engine
