// Which lane this is, over the whole of a dispatch. A dispatch of more than 65,535 workgroups is laid out in two dimensions
// and rounded up, so a kernel compares flatIndex() with its own count and never with the size of the grid.
#ifndef DISPATCH_GLSL
#define DISPATCH_GLSL

#define flatGroup() (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x)
#define flatIndex() (flatGroup() * gl_WorkGroupSize.x + gl_LocalInvocationID.x)

#endif
