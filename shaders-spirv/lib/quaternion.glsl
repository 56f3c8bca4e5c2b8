// Unit quaternions x, y, z, w.
#ifndef QUATERNION_GLSL
#define QUATERNION_GLSL

vec4 turnBack(vec4 q) { return vec4(-q.xyz, q.w); }

vec4 turnAfter(vec4 p, vec4 q) { return vec4(p.w * q.xyz + q.w * p.xyz + cross(p.xyz, q.xyz), p.w * q.w - dot(p.xyz, q.xyz)); }

vec3 turned(vec4 q, vec3 v) {
    vec3 t = 2.0 * cross(q.xyz, v);
    return v + q.w * t + cross(q.xyz, t);
}

mat3 matrixOf(vec4 q) { return mat3(turned(q, vec3(1, 0, 0)), turned(q, vec3(0, 1, 0)), turned(q, vec3(0, 0, 1))); }

#endif
