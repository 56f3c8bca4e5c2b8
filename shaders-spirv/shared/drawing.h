// What a world has for whoever draws it (modules/brittle/drawing/drawing.h), beside the scene's structs.
#ifndef DRAWING_H
#define DRAWING_H

#include "gpu_types.h"

GPU_NAMESPACE_BEGIN

// Of a slot of a body: the surface of what does not break, along the body's own axes; and which body is in it.
struct BodyLook {
    uvec4 surface; // first vertex, corners of its surface, of faces of cuts; w: the body by its index as added, or the slot
};

// The place that matrices count from.
struct DrawnFrom {
    ivec4 sector;
    vec4 offset;
};

// Whose the two draws of a slot are.
struct DrawnBody {
    uint body;        // by its index as added, or the slot of a fragment
    uint step_made;   // that the fragment was made in, counted from 1; 0 for what has been there from the beginning
    uint origin;      // the first body that it was a part of
    float left;       // 1; of what fades and goes less, down to 0: its matrix shrinks it as much
};

GPU_NAMESPACE_END

#ifdef __cplusplus
static_assert(sizeof(gpu::BodyLook) == 16 && sizeof(gpu::DrawnFrom) == 32 && sizeof(gpu::DrawnBody) == 16);
#endif
#endif
