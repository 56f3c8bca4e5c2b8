// Hashes of a fracture's outcome, for comparing devices. Topology and positions follow from integers, so they have the same
// bits on every device. Normals, texture coordinates and masses are rounded by the device and may differ in their last bits.
#pragma once

#include "modules/brittle/fracture/fragments.h"

#include <cstdint>

namespace brittle {

struct Fingerprint {
    uint64_t topology = 0;   // of fragments, in order: cell, counts, and the indices of their triangles
    uint64_t positions = 0;  // of all vertices, in order
    uint64_t attributes = 0; // of their normals and texture coordinates
    uint64_t masses = 0;     // of volumes, centroids and tensors of inertia
    bool operator==(const Fingerprint&) const = default;
};

// FNV-1a (Fowler, Noll, Vo) over the bytes of the values, 64 bits. Independent of padding. Safe from any thread.
Fingerprint fingerprintOf(const FragmentSet& set);

} // namespace brittle
