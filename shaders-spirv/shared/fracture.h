// Numbers that the fracture kernels and the host agree on. Plain preprocessor constants: read by C++ and GLSL.
#ifndef BRITTLE_SHARED_FRACTURE_H
#define BRITTLE_SHARED_FRACTURE_H

// Ids of sites count from 0; what is no site stands above.
#define NO_INDEX 0xffffffffu
#define BOX_BASE 0xfffffff0u  /* six walls of the box: BOX_BASE + 0..5 = -x +x -y +y -z +z */
#define EDGE_BASE 0xffffffe0u /* side of a clipped polygon on edge k of its triangle: EDGE_BASE + k */

// A grid has coordinates from 0 to 2^24, a little more where the walls of its box are; an object's grid is in a tile of space.
#define TILE_BITS 27
#define TILE_MASK ((1 << TILE_BITS) - 1)
#define TILES_IN_ROW 16 /* along x, and as many rows along y */

// Lanes of a workgroup: in kernels whose lanes work together on one element, and, if the host does not set the
// specialization constant to another power of two, in those of a lane an element. Then elements that one workgroup scans.
#define GROUP_SIZE 64
#define FLAT_SIZE_ID 100
#define SCAN_BLOCK 1024

// Specialization constant of the kernels that decide signs, and its values. Kernels that are named *_double know no other.
#define PRECISION_ID 1
#define PRECISION_EXACT 0
#define PRECISION_FAST 1

// Indices into the buffer of counts; the dispatch arguments of a count have the same index.
#define COUNT_SITES 0
#define COUNT_NEIGHBORS 1
#define COUNT_CORNERS 2 /* corners of all cells, each Voronoi vertex up to four times */
#define COUNT_VORONOI_VERTICES 3
#define COUNT_VORONOI_EDGES 4
#define COUNT_MIXED_EDGES 5
#define COUNT_CROSSINGS 6
#define COUNT_MIXED_TRIANGLES 7
#define COUNT_PAIRS 8
#define COUNT_ROUND 9 /* pairs of the current round */
#define COUNT_POLYGONS 10
#define COUNT_SIDES 11
#define COUNT_TRIPLES 12
#define COUNT_FAN_TRIANGLES 13
#define COUNT_POINTS 14 /* mesh vertices, crossings, triple points, Voronoi vertices */
#define COUNT_INTERVALS 15
#define COUNT_SEGMENTS 16
#define COUNT_FACES 17
#define COUNT_CAP_TRIANGLES 18
#define COUNT_NODES 19 /* corners that large faces may have, bridges included */
#define COUNT_COMPONENTS 20
#define COUNT_TRIANGLES 21 /* candidates: whole triangles, fans, both sides of caps */
#define COUNT_FRAGMENTS 22
#define COUNT_VALID 23       /* triangles that are left after collapsed ones are dropped */
#define COUNT_EXACT_SMALL 24 /* cells queued for the exact kernel, by size */
#define COUNT_EXACT_MEDIUM 25
#define COUNT_EXACT_LARGE 26
#define COUNT_HUGE_FACES 27
#define COUNT_LARGE_FACES 28
#define COUNT_RADIX 29
#define COUNT_EMITTED 30 /* triangles of all fragments */
#define COUNT_DRAWS 31
#define COUNT_CAVITIES 32
#define COUNT_SUSPECTS 33 /* caps that may be one side of a flap */
#define COUNT_SUSPECT_SIDES 34
#define COUNT_FILMS 35
#define COUNT_PARTS 36        /* cavities, each part of another component's fragment */
#define COUNT_AGAIN 37        /* candidates, where films have been merged and islands are to be found anew; else 0 */
#define COUNT_SORT 38         /* triangles to be sorted by component */
#define COUNT_WIDE_FACES 39   /* that a lane cannot triangulate */
#define COUNT_ISLAND_PAIRS 40 /* fragments that share a cell */
#define COUNT_PARTINGS 41     /* those of them whose boxes do not lie apart */
#define COUNT_COLLIDERS 42
#define COUNT_COLLIDER_FACES 43
#define COUNT_COLLIDER_VERTICES 44
#define COUNT_COLLIDER_CORNERS 45
#define COUNT_BREAKING 46       /* objects that break together, where the device finds out */
#define COUNT_SOUP_TRIANGLES 47 /* of their surfaces as they are drawn */
#define COUNT_SOUP_CORNERS 48
#define COUNT_MESH_VERTICES 49 /* of what is to be broken: corners of one place are one vertex */
#define COUNT_OWN_TRIANGLES 50
#define COUNT_EARLIER_TRIANGLES 51 /* of faces of earlier cuts */
#define COUNT_MESH_TRIANGLES 52
#define COUNT_MESH_CORNERS 53
#define COUNT_MESH_EDGES 54
#define COUNT_ASKED_SITES 55
#define COUNT_BINS 56     /* of the search grid */
#define COUNT_EVENT 57    /* 1 where the device has found something that breaks */
#define COUNT_CLEARING 58 /* workgroups that clear tables then */
#define CLEARING_GROUPS 64u
#define COUNT_VAST_FACES 59
#define COUNT_VAST_SIDES 60  /* of all vast faces */
#define COUNT_VAST_HALVES 61 /* of their sides and diagonals: VAST_HALVES a side */
#define COUNT_VAST_SPANS 62
#define COUNT_TOTAL 63

// Words after the counts: what went wrong and how much was asked for. STATUS_FAILED != 0 makes every later kernel idle.
#define STATUS_FAILED COUNT_TOTAL
#define STATUS_NEEDED (COUNT_TOTAL + 1) /* one word per count: what the pool would have had to hold */
#define STATUS_BAD_CELLS (2 * COUNT_TOTAL + 1)
#define STATUS_BAD_CLIP (2 * COUNT_TOTAL + 2)
#define STATUS_BAD_LOOKUP (2 * COUNT_TOTAL + 3)
#define STATUS_BAD_DEPTH (2 * COUNT_TOTAL + 4)
#define STATUS_BAD_CAP (2 * COUNT_TOTAL + 5)
#define STATUS_BAD_UNION (2 * COUNT_TOTAL + 6)
#define STATUS_UNPLACED (2 * COUNT_TOTAL + 7)
#define STATUS_WELDED (2 * COUNT_TOTAL + 8)
#define STATUS_DISSOLVED (2 * COUNT_TOTAL + 9)
#define STATUS_REDONE (2 * COUNT_TOTAL + 11)
#define STATUS_EMPTY_CELLS (2 * COUNT_TOTAL + 12)
#define STATUS_ROUNDS_LEFT (2 * COUNT_TOTAL + 13)
#define STATUS_TURNED_OVER (2 * COUNT_TOTAL + 14)
#define STATUS_BAD_WELD (2 * COUNT_TOTAL + 15)
#define STATUS_CROWDED (2 * COUNT_TOTAL + 16)       /* sites in the fullest bin, where there are too many to be ordered */
#define STATUS_TOO_LONG (2 * COUNT_TOTAL + 17)      /* edges and triangles that meet more cells than one lane can walk */
#define STATUS_SIDES (2 * COUNT_TOTAL + 18)         /* of the polygon that had too many */
#define STATUS_JOINED (2 * COUNT_TOTAL + 19)        /* films that have found a host */
#define STATUS_BAD_DIAGRAM (2 * COUNT_TOTAL + 20)   /* Voronoi edges without a beginning: signs were rounded */
#define STATUS_OPEN_OUTLINES (2 * COUNT_TOTAL + 21) /* cut faces whose outline does not close: signs were rounded */
#define STATUS_UNFIT                                                                                                           \
    (2 * COUNT_TOTAL + 22) /* WHOLE_*, where the list of what breaks is followed by a body that there is no room for; else 0 */
#define STATUS_WORDS (2 * COUNT_TOTAL + 32)

#define FAILED_CAPACITY 1u
#define FAILED_CELLS 2u
#define FAILED_CLIP 4u
#define FAILED_CHECK 8u /* something went wrong that stops no kernel */

// A cell as the cutting kernels leave it: planes' site ids, then corners as triples of plane indices.
#define RAW_PLANES 64
#define RAW_CORNERS 112
#define RAW_WORDS (2 + RAW_PLANES + RAW_CORNERS) /* status, counts, ids, packed triples */

#define CELL_OK 0u
#define CELL_UNDECIDED 1u
#define CELL_OVERFLOW 2u
#define CELL_OPEN                                                                                                              \
    3u /* cut but for a few sites, which are in doubt: their ids stand at RAW_OPEN, their number above the status */
#define MOST_OPEN 16
#define RAW_OPEN (RAW_WORDS - MOST_OPEN)

// Mesa's software device stops a lane without a word after 65,535 loop turns: what could come near asks beforehand, or
// counts, and fails the event with a message.
#define MOST_IN_A_BIN 16384u
#define MOST_TURNS 50000u
#define MOST_CELLS_OF_AN_EDGE 8000u
#define MOST_LINEAR_SITES 100000u /* that a lane can go through twice, LINEAR_AT_ONCE a turn */
#define LINEAR_AT_ONCE 8u
#define MOST_TREE_LEVELS 24u
#define FEW_SITES 1024     /* that one workgroup sorts in shared memory, into as many bins */
#define TRIES_A_ROUND 512u /* to place a site inside the mesh */
#define PAPER_CANDIDATES 8   /* a site, of the paper's pattern: section 2 */
#define PAPER_LANES 256      /* that draw candidates, each one: the most that a site may have */

// Sides of a clipped polygon; one that outgrows the usual number has the event done again with the larger.
#define USUAL_SIDES 24
#define MOST_SIDES 320

// Segments of a cap: up to these a face is one lane's, a small workgroup's, a large one's. What has more is a vast face, on which
// all workgroups work together. A side of it has five half-edges: its own, and both halves of two diagonals from its corner.
#define SMALL_FACE 24
#define LARGE_FACE 256
#define HUGE_FACE 2048
#define VAST_HALVES 5
#define VAST_ROUNDS 12 /* in which all workgroups cut ears, before a lane finishes each part */
#define POINT_FRACTION_BITS 24
#define INNER_BIT 0x80000000u /* of a triangle's source: a cap, not a mesh triangle */
#define FLAP_BIT 0x40000000u  /* dropped as one side of a flap */

#define FATE_FRAGMENT 0u
#define FATE_DISSOLVED 1u
#define FATE_CAVITY 2u
#define FATE_FILM 3u   /* too thin, and not decided yet */
#define FATE_JOINED 4u /* and the round: a film that has found its host */

#define RADIX_BITS 4
#define RADIX_TILE 1024

#endif
