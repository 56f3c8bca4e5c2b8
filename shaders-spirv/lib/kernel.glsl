// What every fracture kernel needs: extensions, the shared constants, buffer declarations, and the flat index of a lane.
#ifndef KERNEL_GLSL
#define KERNEL_GLSL
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "shared/fracture.h"

#define READS(slot, type, name) layout(set = 0, binding = slot, std430) readonly buffer name##_block { type name[]; }
#define WRITES(slot, type, name) layout(set = 0, binding = slot, std430) writeonly buffer name##_block { type name[]; }
#define UPDATES(slot, type, name) layout(set = 0, binding = slot, std430) buffer name##_block { type name[]; }
// A lane an element, in workgroups of the size that the host asks for: nothing but the grid may depend on it.
#define FLAT_KERNEL layout(local_size_x = GROUP_SIZE, local_size_x_id = FLAT_SIZE_ID) in
// A workgroup an element or a block: what its lanes add up comes out the same only if they are always as many.
#define GROUP_KERNEL layout(local_size_x = GROUP_SIZE) in

// A number of turns that the compiler cannot see is a loop that it does not unroll: small loops around large bodies, copied
// out by a driver, are most of what a first dispatch waits for. Kernels run on grids of depth 1.
#define ROLLED(n) (uint(n) * gl_NumWorkGroups.z)

uint flatGroup() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }
#define flatIndex() (flatGroup() * gl_WorkGroupSize.x + gl_LocalInvocationID.x)

#endif
