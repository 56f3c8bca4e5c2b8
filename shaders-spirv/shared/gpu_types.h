// The bridge between C++ and GLSL: a header that includes this is read by both, and its structs lie alike in both, with
// std430 on the GPU side. Members are scalars, arrays of scalars (tight in std430), vec2, vec4, ivec4, uvec4 and mat4; no vec3,
// which std430 aligns to 16 bytes and C++ does not. tests/layout_test.cpp compares the offsets in every built kernel.
#ifndef GPU_TYPES_H
#define GPU_TYPES_H

#ifdef __cplusplus

#include <cstdint>

#define GPU_NAMESPACE_BEGIN namespace gpu {
#define GPU_NAMESPACE_END }

namespace gpu {

using uint = uint32_t;

struct alignas(8) vec2 {
    float x, y;
};

struct alignas(16) vec4 {
    float x, y, z, w;
};

struct alignas(16) uvec4 {
    uint x, y, z, w;
};

struct alignas(16) ivec4 {
    int32_t x, y, z, w;
};

// By columns, as in GLSL.
struct alignas(16) mat4 {
    float m[16];
};

} // namespace gpu

#else

#define GPU_NAMESPACE_BEGIN
#define GPU_NAMESPACE_END

#endif
#endif
