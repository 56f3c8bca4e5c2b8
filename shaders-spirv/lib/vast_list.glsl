// Lists a face as vast. Wants counts, vast_faces, cap_counts and cap_slots declared.

// Counted as bad until the kernels of vast faces have made its cap.
void listVast(uint index, uint size) {
    uint at = atomicAdd(counts[COUNT_VAST_FACES], 1u), side = atomicAdd(counts[COUNT_VAST_SIDES], size);
    if (at < vast_faces.length()) vast_faces[at] = VastFace(index, side, size, 0u);
    cap_counts[index] = 0u;
    cap_slots[index] = 0u;
    atomicAdd(counts[STATUS_BAD_CAP], 1u);
}
