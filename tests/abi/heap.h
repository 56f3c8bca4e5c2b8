// A host's allocator that knows what it has given away, and may run out.
#pragma once

#include "modules/brittle/brittle.h"

#include <cstdlib>
#include <map>

namespace abi_test {

struct Heap {
    std::map<void*, size_t> blocks;
    size_t allocations = 0, most = ~size_t{0};
    bool mixed_up = false;

    BrittleAllocator allocator() {
        return {[](void* user, size_t size, size_t alignment) { return static_cast<Heap*>(user)->take(size, alignment); },
                [](void* user, void* memory, size_t size, size_t) { static_cast<Heap*>(user)->give(memory, size); }, this};
    }
    void* take(size_t size, size_t alignment) {
        if (allocations == most) return nullptr;
        ++allocations;
        void* memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
        blocks[memory] = size;
        return memory;
    }
    void give(void* memory, size_t size) {
        const auto found = blocks.find(memory);
        mixed_up = mixed_up || found == blocks.end() || found->second != size;
        if (found != blocks.end()) blocks.erase(found);
        std::free(memory);
    }
};

} // namespace abi_test
