// Cross and dot products with the same bits on every device. Vulkan rounds each addition and product alike, but lets a driver
// fuse the built-in cross() and dot(), whatever `precise` says: an NVIDIA H100 does. Fused, the cross product of parallel edges
// is not zero, and a piece without volume seems to have some.
#ifndef ROUNDED_ALIKE_GLSL
#define ROUNDED_ALIKE_GLSL

vec3 alikeCross(vec3 u, vec3 v) {
    precise vec3 normal = vec3(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
    return normal;
}

float alikeDot(vec3 u, vec3 v) {
    precise float sum = u.x * v.x + u.y * v.y + u.z * v.z;
    return sum;
}

#endif
