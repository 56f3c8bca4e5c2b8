// How fast a body's points move by its turning, at most. Wants `bodies` and `shapes` declared.
float rimSpeed(uint body) { return bodies[body].offset.w == 0.0 ? 0.0 : length(bodies[body].spin.xyz) * shapes[body].inverse_inertia[2].w; }
