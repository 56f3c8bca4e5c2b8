// Publishes a count with the dispatch arguments of the kernels that run over it. Wants `counts` and `args` declared.
// All or nothing: a count over its pool's capacity is recorded, and every later kernel of the event idles.
layout(constant_id = FLAT_SIZE_ID) const uint flat_size = GROUP_SIZE;

void setArguments(uint at, uint groups) {
    args[at] = min(groups, 65535u);
    args[at + 1u] = (groups + 65534u) / 65535u;
    args[at + 2u] = 1u;
}

void publishCount(uint index, uint total, uint capacity) {
    if (total > capacity) {
        counts[STATUS_NEEDED + index] = total;
        atomicOr(counts[STATUS_FAILED], FAILED_CAPACITY);
    }
    uint usable = counts[STATUS_FAILED] != 0u ? 0u : total;
    counts[index] = usable;
    setArguments(9u * index, (usable + flat_size - 1u) / flat_size);
    setArguments(9u * index + 3u, (usable + SCAN_BLOCK - 1u) / SCAN_BLOCK);
    setArguments(9u * index + 6u, usable);
}
