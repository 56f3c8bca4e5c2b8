// Checks that the accessors of a COLLADA file stay within their arrays. Assimp 5.2 reads on behind the end.
#pragma once

#include "modules/brittle/mesh/interchange/collada_tags.h"

#include <cstdint>
#include <map>
#include <vector>

namespace brittle {

// What is wrong in a file; `at` is a view into it.
struct ColladaFault {
    std::string_view at;
    std::string what;
};

class ColladaArrays {
public:
    // Call for every tag of the file, in order.
    std::optional<ColladaFault> check(const Tag& tag);
    // Arrays with more numbers than they count.
    size_t longArrays() const { return long_arrays_; }

private:
    struct Accessor {
        std::string_view at, source;
        uint64_t offset = 0, count = 0, stride = 1, params = 0;
        bool has_names = false;
    };

    std::optional<ColladaFault> checkArray(const Tag& tag);
    std::optional<ColladaFault> checkAccessor(const Accessor& accessor) const;

    std::map<std::string_view, uint64_t> sizes_; // of arrays, by their ids
    std::optional<Accessor> accessor_;           // whose params are read
    size_t long_arrays_ = 0;
};

} // namespace brittle
