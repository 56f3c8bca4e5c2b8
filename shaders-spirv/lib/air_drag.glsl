// Air slows a body as it would the ball around it: F = -1/2 density * coefficient * area * |v| v, and in the same way the speed
// of its rim. Over a step in which nothing else acts the equation has an exact solution, v / (1 + k |v| t), which never turns a
// velocity around, however long the step.
//
// `strength`: half of density times coefficient times pi.
vec3 slowedBy(vec3 v, float k, float duration) { return v / (1.0 + k * duration * length(v)); }

vec3 velocityInAir(vec3 velocity, float inverse_mass, BodyShape shape, float strength, float duration) {
    float radius = shape.inverse_inertia[2].w;
    return slowedBy(velocity, strength * radius * radius * inverse_mass, duration);
}

// By the mean of its inverse moments, so that the axis stays.
vec3 spinInAir(vec3 spin, BodyShape shape, float strength, float duration) {
    float radius = shape.inverse_inertia[2].w, square = radius * radius;
    float inverse = (shape.inverse_inertia[0].x + shape.inverse_inertia[1].y + shape.inverse_inertia[2].z) / 3.0;
    return slowedBy(spin, strength * radius * square * square * inverse, duration);
}
