// The scene's buffers, as fracture fills them and the renderer draws them. Object i has the draw commands 2 i (outer faces)
// and 2 i + 1 (inner faces), whose first_instance says the same number: object and side of what is being drawn.
#ifndef SCENE_H
#define SCENE_H

#include "gpu_types.h"

GPU_NAMESPACE_BEGIN

#define SIDE_OUTER 0
#define SIDE_INNER 1

struct SceneVertex {
    float position[3];
    float normal[3];
    float uv[2];
};

// VkDrawIndexedIndirectCommand.
struct DrawCommand {
    uint index_count;
    uint instance_count;
    uint first_index;
    int vertex_offset;
    uint first_instance;
};

struct ObjectMatrix {
    mat4 model;
};

// Linear. What has none of its own has those of DrawPush.
struct ObjectColor {
    vec4 outer; // w: how much of it is light and shade, 0 for a color that is seen as it is
    vec4 inner; // w: how far from the eye it has faded out, 0 for what does not fade
};

struct Bounds {
    float lower[3];
    float upper[3];
};

// A rigid body. Fracture writes the center of mass and leaves the rest 0.
struct ObjectState {
    float position[3]; // center of mass
    float inverse_mass;
    float orientation[4];
    float velocity[3];
    float radius;
    float angular_momentum[3];
    uint fragment;
    float inertia[6]; // xx yy zz xy xz yz
    uint material;
    uint flags;
};

// How the renderer draws: one push block for all of its shaders.
struct DrawPush {
    mat4 view_projection;
    vec4 eye;           // w: tint, how far the colors of the fragments differ
    vec4 key_direction; // towards the light; w: its strength
    vec4 outer_color;   // linear; w: 1 where every object has colors of its own
    vec4 inner_color;   // linear
};

GPU_NAMESPACE_END

#endif
