// A vector with another number in one place, by choices: a place that only a lane knows is a write to memory, which a software device
// takes most of a second to compile where there are many.
vec4 withComponent(vec4 v, uint place, float x) { return mix(v, vec4(x), equal(uvec4(place), uvec4(0u, 1u, 2u, 3u))); }
