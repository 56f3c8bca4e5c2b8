// Candidates of a cell from all sites, which pass through shared memory (the paper, section 4: the best for few sites): first
// those nearby, so that the rest finds a small cell. The lanes of a workgroup go through the same sites together.
// Wants the push constant bins, and lib/fast_cell.glsl.
#define CHUNK 1024
#define MOST_SEARCH_TURNS 8192u

shared ivec4 chunk[CHUNK];
shared uint waiting;

// The same for all lanes, but for `at`.
uint chunk_first, chunk_end, site_total;
bool near_pass;
uint at;
float near_square;

void loadChunk(uint first) {
    chunk_first = first;
    chunk_end = min(first + CHUNK, site_total);
    for (uint k = gl_LocalInvocationID.x; first + k < chunk_end && k < CHUNK; k += gl_WorkGroupSize.x) chunk[k] = bin_sites[first + k];
    at = first;
    barrier();
}

void beginSearch(uint lane, ivec3 site) {
    site_total = counts[COUNT_SITES];
    near_pass = true;
    near_square = 2.0 * float(bins.w) * float(bins.w);
    loadChunk(0u);
}

// Whether any lane of the workgroup has more to do with this chunk or later ones.
bool searchGoesOn() {
    barrier();
    if (gl_LocalInvocationID.x == 0u) waiting = 0u;
    barrier();
    if (phase != kFinished) waiting = 1u;
    barrier();
    return waiting != 0u;
}

void listIfNear(uint lane, ivec3 site, uint k) {
    vec3 d = vec3(chunk[min(k - chunk_first, CHUNK - 1u)].xyz - site);
    float square = dot(d, d);
    bool its_pass = (square <= near_square) == near_pass;
    if (k < chunk_end && k != lane && its_pass && square <= reach) list(k, square);
}

void fillList(uint lane, ivec3 site) {
    for (uint guard = 0u; guard < CHUNK && at < chunk_end && count + LINEAR_AT_ONCE <= LIST && phase == kSearching; guard++) {
        [[unroll]] for (uint k = 0u; k < LINEAR_AT_ONCE; k++) listIfNear(lane, site, at + k);
        at += LINEAR_AT_ONCE;
    }
}

// The workgroup goes to the next chunk when all its lanes are through with this one.
bool searchEnds(ivec3 site) {
    barrier();
    if (gl_LocalInvocationID.x == 0u) waiting = 0u;
    barrier();
    if (phase == kSearching && at < chunk_end) waiting = 1u;
    barrier();
    bool through = waiting == 0u, last = through && chunk_end >= site_total && !near_pass;
    barrier();
    if (through && !last) {
        near_pass = near_pass && chunk_end < site_total;
        loadChunk(chunk_end < site_total ? chunk_end : 0u);
    }
    return last;
}
