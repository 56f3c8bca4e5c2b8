#include "modules/brittle/fracture/fingerprint.h"

#include "modules/brittle/mesh/byte_hash.h"

#include <span>

namespace brittle {
namespace {

template <class Value>
void addTo(ByteHash& hash, const Value& value) {
    hash.add(std::as_bytes(std::span(&value, 1)));
}

uint64_t topologyOf(const FragmentSet& set) {
    ByteHash hash;
    for (const Fragment& f : set.fragments)
        for (const uint32_t number : {f.cell, f.vertex_count, f.outer_index_count, f.earlier_index_count, f.inner_index_count})
            addTo(hash, number);
    for (const uint32_t index : set.indices)
        addTo(hash, index);
    return hash.value();
}

uint64_t massesOf(const FragmentSet& set) {
    ByteHash hash;
    for (const Fragment& f : set.fragments) {
        addTo(hash, f.volume);
        addTo(hash, f.centroid);
        addTo(hash, f.inertia);
    }
    return hash.value();
}

} // namespace

Fingerprint fingerprintOf(const FragmentSet& set) {
    ByteHash positions, attributes;
    for (const FragmentVertex& v : set.vertices) {
        addTo(positions, v.position);
        addTo(attributes, v.normal);
        addTo(attributes, v.uv);
    }
    return {topologyOf(set), positions.value(), attributes.value(), massesOf(set)};
}

} // namespace brittle
