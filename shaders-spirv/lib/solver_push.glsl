// The push constants of kernels that solve contacts one pass at a time: SolverPush, member by member.
layout(push_constant) uniform Push {
    vec4 gravity;
    vec4 soft;
    vec4 stiff;
    uint color;
    uint with_push;
    uint first_substep;
    uint substeps;
};
const bool rubs_in_push = true, keeps_first = false;
float wholeStep() { return float(substeps) * gravity.w; }
