#include "modules/brittle/fracture/fingerprint.h"

#include <cstddef>
#include <span>

namespace brittle {
namespace {

class ByteHash {
public:
    template <class Value>
    void add(const Value& value) {
        for (const std::byte b : std::as_bytes(std::span(&value, 1)))
            value_ = (value_ ^ static_cast<uint64_t>(b)) * 0x100000001b3u;
    }
    uint64_t value() const { return value_; }

private:
    uint64_t value_ = 0xcbf29ce484222325u;
};

uint64_t topologyOf(const FragmentSet& set) {
    ByteHash hash;
    for (const Fragment& f : set.fragments)
        for (const uint32_t number : {f.cell, f.vertex_count, f.outer_index_count, f.earlier_index_count, f.inner_index_count})
            hash.add(number);
    for (const uint32_t index : set.indices)
        hash.add(index);
    return hash.value();
}

uint64_t massesOf(const FragmentSet& set) {
    ByteHash hash;
    for (const Fragment& f : set.fragments) {
        hash.add(f.volume);
        hash.add(f.centroid);
        hash.add(f.inertia);
    }
    return hash.value();
}

} // namespace

Fingerprint fingerprintOf(const FragmentSet& set) {
    ByteHash positions, attributes;
    for (const FragmentVertex& v : set.vertices) {
        positions.add(v.position);
        attributes.add(v.normal);
        attributes.add(v.uv);
    }
    return {topologyOf(set), positions.value(), attributes.value(), massesOf(set)};
}

} // namespace brittle
