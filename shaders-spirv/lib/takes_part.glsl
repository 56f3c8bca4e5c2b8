// Whether a body takes part in one blow a step at most: what neither moves nor breaks has nothing to pay with and nothing to lose, and
// takes part in any number. Wants `bodies` and `breakable` declared.
bool takesPart(uint body) { return bodies[body].offset.w != 0.0 || breakable[body].surface.y > 0u; }
