// A cell as lib/edge_cell.glsl cuts it, in shared memory: planes, corners with their planes, and edges.
#include "lib/filter_bounds.glsl"
#include "lib/rounded_cut.glsl"

#define PLANES RAW_PLANES
#define CORNERS RAW_CORNERS
#define EDGES (3 * CORNERS / 2)

shared vec4 plane_d[PLANES];
shared uint plane_id[PLANES];
shared vec4 corner_copies[2][CORNERS]; // w and a bound of its error
shared uint triple_copies[2][CORNERS]; // planes in the order in which their normals make a positive volume
shared uint edge_copies[2][EDGES];     // left | right << 8 | from << 16 | to << 24
shared uint corner_goes[CORNERS];      // 0 or 1, then the new place of one that stays
shared uint entry[PLANES];             // new corner where a face's rim comes back to it, and above ENTERED how often it does
shared uint trouble;

uint copy, edge_count; // the same for all lanes

#define corner_place corner_copies[copy]
#define ENTERED 0x10000u

void sync() { barrier(); }
