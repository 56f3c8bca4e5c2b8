// The sphere tree (the paper, section 4, figure 7): a node has an initial site and one that was inserted into it, for which it
// is named; its children have one or the other for their own initial site. Every further site goes down to the child whose
// initial site is nearer, the lowest of those that arrive in a level is inserted there, and so the tree grows a level at a time
// for all sites at once. `path` remembers the node and side each site has come to. Depth is bounded: sites that are left after
// the last level are listed at the leaf they have come to.
//
// A node is a uvec4: initial site; both children, 0 for none, else 1 more than their site; bits of the squared distance from
// the initial site to the furthest below. Sites are places in bin_sites.
#define PLACED 0x80000000u
#include "lib/hash.glsl" // inserting sites in the order of their bins would make a list of the tree

uvec2 rootOf(uint n) { return uvec2(n / 4u, 3u * n / 4u); } // apart from each other in z

// Exact below 2^24 and rounded up above: a radius must not come out too small.
uint radiusBits(ivec3 d) {
    float square = dot(vec3(d), vec3(d));
    return floatBitsToUint(square * (1.0 + 1.0 / 1048576.0));
}

// `at`: the node and the side of it that a site has come to.
uint childAt(uint at, uvec4 node) { return ((at & 1u) != 0u ? node.z : node.y) - 1u; }
uint initialAt(uint at, uvec4 node) { return (at & 1u) != 0u ? at >> 1 : node.x; }
