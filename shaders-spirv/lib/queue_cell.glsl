// Leaves a cell to the exact kernel, and publishes a workgroup for it: a dispatch between the two would cost as much as the cell.
// Wants `counts`, `queue` and `args` declared.
void queueCell(uint cell) {
    uint slot = atomicAdd(counts[COUNT_EXACT_SMALL], 1u), groups = 9u * COUNT_EXACT_SMALL + 6u;
    queue[slot] = cell;
    atomicMax(args[groups], min(slot + 1u, 65535u));
    atomicMax(args[groups + 1u], slot / 65535u + 1u);
    atomicMax(args[groups + 2u], 1u);
}
