// Candidates of a cell from the sphere tree, nearer subtrees first. Wants tree, leaf_start, leaf_sites and lib/fast_cell.glsl.
#include "lib/sphere_tree.glsl"

#define MOST_SEARCH_TURNS 1024u

uint stack[MOST_TREE_LEVELS + 2];
uint depth, leaf_at, leaf_end;

void beginSearch(uint lane, ivec3 site) {
    uint total = counts[COUNT_SITES];
    uvec2 root = rootOf(total);
    depth = total > 1u ? 1u : 0u;
    stack[0] = root.y;
    leaf_at = 0u;
    leaf_end = 0u;
    vec3 d = vec3(bin_sites[root.x].xyz - site);
    if (total > 1u && root.x != lane) list(root.x, dot(d, d));
}

bool searchGoesOn() { return phase != kFinished; }

void listWithinReach(uint lane, ivec3 site, uint place) {
    vec3 d = vec3(bin_sites[place].xyz - site);
    float square = dot(d, d);
    if (place != lane && square <= reach) list(place, square);
}

void push(uint child) {
    stack[min(depth, MOST_TREE_LEVELS + 1u)] = child - 1u;
    depth += child != 0u ? 1u : 0u;
}

// A site d cuts corner w where d.w > d.d: inside the ball with w for a diameter, whose center is w/2. So none of a sphere of
// radius r around c does where c.c - c.w > r r + r |w|. This holds for cells that reach far in one direction only, too: they
// need not look at all that is as near in others.
bool mayHoldNeighbors(vec3 c, float radius_square) {
    float radius = sqrt(radius_square) * (1.0 + kTestError);
    float square = dot(c, c), slack = square * kTestError;
    return square - slack <= furthestAlong(c) + (radius * radius + radius * sqrt(reach)) * (1.0 + 2.0 * kTestError);
}

// Takes a node from the stack: its own site, its leaf's list, its children.
void visit(uint lane, ivec3 site) {
    depth--;
    uint n = stack[depth];
    uvec4 node = tree[n];
    vec3 to_initial = vec3(bin_sites[node.x].xyz - site), to_inserted = vec3(bin_sites[n].xyz - site);
    float square = dot(to_inserted, to_inserted), square_initial = dot(to_initial, to_initial);
    bool meets = mayHoldNeighbors(to_initial, uintBitsToFloat(node.w));
    if (meets && n != lane && square <= reach) list(n, square);
    leaf_at = leaf_start[n];
    leaf_end = meets ? leaf_start[n + 1u] : leaf_at;
    bool initial_nearer = square_initial <= square;
    push(meets ? (initial_nearer ? node.z : node.y) : 0u);
    push(meets ? (initial_nearer ? node.y : node.z) : 0u);
}

void fillList(uint lane, ivec3 site) {
    for (uint guard = 0u; guard < 4096u && phase == kSearching && count < LIST && budget > 0u && (depth > 0u || leaf_at < leaf_end); guard++) {
        if (leaf_at >= leaf_end) visit(lane, site);
        for (uint k = 0u; k < 4096u && leaf_at < leaf_end && count < LIST && budget > 0u; k++) {
            listWithinReach(lane, site, leaf_sites[leaf_at]);
            leaf_at++;
            budget--;
        }
        budget -= min(budget, 1u);
    }
}

bool searchEnds(ivec3 site) { return depth == 0u && leaf_at >= leaf_end; }
