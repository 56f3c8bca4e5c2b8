// The pools of a running world: arrays of which objects have ranges. Objects that break or expire return theirs and fragments
// take new ones, in the middle of a step and without the host.
//
// What is free of a pool is a list of ranges, in order, none of which touch, in one half of a table; what changes the list
// writes it into the other half. Every object has one range of a pool, so that no more free ranges can lie between them than
// there are objects, and one behind them; and between two of them lies an element at least: that bounds the table.
#ifndef POOL_H
#define POOL_H

#include "gpu_types.h"

GPU_NAMESPACE_BEGIN

#define POOLS 4
#define POOL_BODIES 0
#define POOL_PIECES 1
#define POOL_FACES 2     /* of hulls */
#define POOL_TRIANGLES 3 /* of surfaces */

// The most that the kernels can walk through before loop turns run out (shaders-spirv/README.md), whatever their lanes.
#define POOL_MOST_FREE 32768 /* ranges: five levels of eight */
#define POOL_MOST_RETURNED 8192
#define POOL_MOST_OWNERS 1024
#define POOL_MOST_REQUESTS 8192

// Bits of a header's status, which stay until the host takes them away. All are bugs of whoever uses the pools.
#define POOL_RETURNED_TWICE 1u   /* what was free already, or two returned the same */
#define POOL_RETURNED_OUTSIDE 2u /* a range that reaches beyond the pool; it is left out */
#define POOL_TABLE_FULL 4u       /* more free ranges than the table holds; the last are lost */
#define POOL_LIST_FULL 8u        /* more returned, owners or requests than there is room for; what is beyond is left out */

struct PoolHeader {
    uint capacity; // elements
    uint free_ranges;
    uint in_use; // with what is lost
    uint most_in_use;
    uint lacked; // how many owners it had too little for
    uint status;
    uint returned_twice; // elements
    uint lost;           // elements
    uint side;           // half of the table, in which the list is
};

// What an object has of all pools. Where the size is 0 it has nothing there.
struct PoolShare {
    uvec4 begin;
    uvec4 size;
};

GPU_NAMESPACE_END

#ifdef __cplusplus
static_assert(sizeof(gpu::PoolHeader) == 36);
static_assert(sizeof(gpu::PoolShare) == 32);
#endif
#endif
