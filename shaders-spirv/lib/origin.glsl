// Who is in a slot of a body: the step that a fragment was made in, 0 for what has always been; the slot of the first body that it
// was a part of, its own for what is no fragment. Wants `breakable` declared.
uint bornIn(uint body) { return uint(breakable[body].balance.w); }
uint originOf(uint body) { return bornIn(body) != 0u ? uint(breakable[body].low.w) : body; }

const float kForEver = 3e38; // s, of what no step has room for: it never breaks

// Of bodies that can break. What left the world cannot (lib/leave_world.glsl).
bool isFragment(uint body) { return breakable[body].surface.w != NO_INDEX && bornIn(body) != 0u; }
bool isWhole(uint body) {
    return breakable[body].surface.w != NO_INDEX && bornIn(body) == 0u && breakable[body].form.w < kForEver;
}
