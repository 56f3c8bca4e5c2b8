// Numbers that the broad phase and the host agree on. Its counts lie in a buffer of their own, laid out like that of a fracture
// event (fracture.h): counts, then STATUS_FAILED and what was needed; so all primitives run on it.
#ifndef BRITTLE_SHARED_BROAD_PHASE_H
#define BRITTLE_SHARED_BROAD_PHASE_H

#include "fracture.h"

// Bits in w of a box's high corner.
#define BOX_STATIC 1u /* does not move: never paired with another such */
#define BOX_ABSENT 2u /* a free slot: paired with nothing */

// Indices into the counts. COUNT_RADIX is not to be used for anything else there either.
#define COUNT_BOXES 0       /* in: slots of pieces, the free ones included */
#define COUNT_BOX_PAIRS 1   /* out */
#define COUNT_TREE_BOXES 2  /* boxes where there are more than FEW_BOXES, else 0: what makes the tree idles then */
#define COUNT_TREE_PAIRS 3  /* pairs that were found in the tree */
#define COUNT_FOUND_PAIRS 4 /* of these, how many have been written down yet */
#define COUNT_LONG_LISTS 5  /* pieces that come first in more than LONG_LIST pairs */

// A bit of STATUS_FAILED: a piece met so many others that a lane ran out of loop turns.
#define FAILED_PAIRING 8u

// Up to so many boxes each is held against each, by one workgroup.
#define FEW_BOXES 256
// Pairs of one piece that are put in order by comparing each with each.
#define LONG_LIST 64
// A moving box is large if it is more than two to the power of this times as long as boxes that move are on average.
#define LARGE_BITS 4
// Steps of the curve along each axis, as a power of two, and how a place on it is split over two words.
#define CURVE_BITS 20
#define KEY_LOW_BITS 30
#define KEY_HIGH_BITS 32 /* the class of the box on top */

// The order of the leaves: first what is asked, in the end what is only found.
#define CLASS_MOVING 0u
#define CLASS_LARGE 1u
#define CLASS_STATIC 2u
#define CLASS_ABSENT 3u

// Words of the extent of all boxes.
#define EXTENT_BELOW 0   /* per axis, the least center, so encoded that greater is less */
#define EXTENT_ABOVE 3   /* per axis, the greatest center */
#define EXTENT_SIZES 6   /* sum of the exponents of the sizes of moving boxes */
#define EXTENT_MOVING 7  /* how many these are */
#define EXTENT_WORDS 8

// One workgroup sorts up to so many keys, a digit of so many bits at a time.
#define GROUP_SORT_BITS 5
#define GROUP_SORT_LANES 64

// Boxes that one workgroup of join_boxes makes one of, and that as a power of two.
#define JOIN_BLOCK 1024
#define JOIN_BITS 10
#define NO_BODY 0xffffffffu /* in a node: pieces of more than one body */

// Lists that a bitmap in shared memory puts in order have ids of so many bits at a time.
#define BITMAP_WORDS 2048

#endif
