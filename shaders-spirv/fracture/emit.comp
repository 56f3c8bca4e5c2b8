// Writes the triangles into the scene's pools: the model's own surface, faces of earlier cuts, inner ones. Outer corners take normal
// and texture coordinates from the mesh triangle that they lie on, by their barycentric place in it. Inner corners get the
// bisector's normal, and texture coordinates in model units along it.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, order);
READS(2, uint, components);
READS(3, uvec4, pieces);
READS(4, uint, sources);
READS(5, vec4, positions);
READS(6, uvec4, class_offsets);
READS(7, uint, component_start);
READS(8, uvec4, shares);
READS(9, uvec4, demand_offsets);
READS(10, uvec2, fates);
READS(11, float, mesh_positions);
READS(12, uint, triangles);
READS(13, float, corner_attributes); // normal, uv, of the corners of mesh triangles from first_source on
WRITES(14, float, vertices);
WRITES(15, uint, indices);
// A binding may be smaller than the pools and the mesh: a dispatch writes triangles of one part of the pools, from one part of the
// mesh. Inner triangles come with the first part of the mesh.
layout(push_constant) uniform Push {
    uint first_triangle;
    uint triangle_count;
    uint first_source;
    uint source_count;
};

vec3 modelVertex(uint v) { return vec3(mesh_positions[3u * v], mesh_positions[3u * v + 1u], mesh_positions[3u * v + 2u]); }

float largest(vec3 v) { return max(abs(v.x), max(abs(v.y), abs(v.z))); }

// Of edges of any length: squares of tiny ones are no numbers any more.
vec3 normalOf(vec3 u, vec3 w) {
    vec3 n = cross(u / max(largest(u), 1e-37), w / max(largest(w), 1e-37));
    float size = length(n);
    return size > 0.0 ? n / size : vec3(0.0, 0.0, 1.0);
}

vec3 barycentric(vec3 p, vec3 a, vec3 b, vec3 c) {
    float scale = 1.0 / max(max(largest(b - a), largest(c - a)), 1e-37);
    p = (p - a) * scale;
    b = (b - a) * scale;
    c = (c - a) * scale;
    a = vec3(0.0);
    vec3 n = cross(b - a, c - a);
    float size = max(dot(n, n), 1e-38);
    vec3 w = vec3(dot(n, cross(c - b, p - b)), dot(n, cross(a - c, p - c)), dot(n, cross(b - a, p - a))) / size;
    w = clamp(w, 0.0, 1.0);
    return w / max(w.x + w.y + w.z, 1e-20);
}

float cornerAttribute(uint corner, uint k) { return corner_attributes[5u * corner + k]; }

void saveVertex(uint v, vec3 p, vec3 n, vec2 uv) {
    vertices[8u * v] = p.x;
    vertices[8u * v + 1u] = p.y;
    vertices[8u * v + 2u] = p.z;
    vertices[8u * v + 3u] = n.x;
    vertices[8u * v + 4u] = n.y;
    vertices[8u * v + 5u] = n.z;
    vertices[8u * v + 6u] = uv.x;
    vertices[8u * v + 7u] = uv.y;
}

void main() {
    uint k = flatIndex();
    if (k >= counts[COUNT_VALID] || counts[STATUS_FAILED] != 0u) return;
    uint t = order[k], c = components[t];
    uvec3 rank = class_offsets[k].xyz, until = class_offsets[k + 1u].xyz, total = shares[2u * c + 1u].xyz;
    if (rank == until) return;
    uvec3 within = rank - class_offsets[component_start[c]].xyz + shares[2u * c].xyz;
    uint first = demand_offsets[fates[c].y].y;
    uint local = until.x != rank.x ? within.x : total.x + (until.y != rank.y ? within.y : total.y + within.z);
    uint to_triangle = first + local - first_triangle;
    if (first + local < first_triangle || to_triangle >= triangle_count) return;
    uvec4 piece = pieces[t];
    uint source = sources[t] & ~INNER_BIT;
    bool cap = (sources[t] & INNER_BIT) != 0u;
    uint m = cap ? 0u : source, from = m - first_source;
    if (cap ? first_source != 0u : from >= source_count) return;
    vec3 a = modelVertex(triangles[3u * m]), b = modelVertex(triangles[3u * m + 1u]), d = modelVertex(triangles[3u * m + 2u]);
    vec3 p0 = positions[piece.x].xyz, p1 = positions[piece.y].xyz, p2 = positions[piece.z].xyz;
    vec3 flat_normal = normalOf(p1 - p0, p2 - p0);
    vec3 along = abs(flat_normal.x) > 0.7 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
    vec3 u = normalize(cross(along, flat_normal)), w = cross(flat_normal, u);
    for (uint corner = 0u; corner < ROLLED(3); corner++) {
        vec3 p = positions[piece[corner]].xyz;
        vec3 weight = barycentric(p, a, b, d);
        vec3 n = vec3(0.0);
        vec2 uv = vec2(0.0);
        for (uint s = 0u; s < ROLLED(3); s++) {
            uint at = 3u * from + s;
            n += weight[s] * vec3(cornerAttribute(at, 0u), cornerAttribute(at, 1u), cornerAttribute(at, 2u));
            uv += weight[s] * vec2(cornerAttribute(at, 3u), cornerAttribute(at, 4u));
        }
        float length_ = length(n);
        n = length_ > 1e-6 ? n / length_ : flat_normal;
        uint to = 3u * to_triangle + corner;
        saveVertex(to, p, cap ? flat_normal : n, cap ? vec2(dot(p, u), dot(p, w)) : uv);
        indices[to] = 3u * local + corner;
    }
}
