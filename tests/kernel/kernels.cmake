# Kernels that only the tests use: each calls functions of shaders-spirv/lib on lists of inputs.
kernel(wide_ops.comp)
kernel(corner_cuts.comp)
kernel(mesh_signs.comp)
kernel(fractions.comp)
kernel(body_strengths.comp)
kernel(breaking_laws.comp)
kernel(angles.comp)
