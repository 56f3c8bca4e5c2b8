// The host's allocator, as C++ asks for one.
#pragma once

#include "modules/brittle/brittle.h"

#include <memory_resource>
#include <new>

namespace brittle::abi {

class HostMemory final : public std::pmr::memory_resource {
public:
    // Without functions: the process's heap.
    explicit HostMemory(const BrittleAllocator& allocator) : allocator_(allocator) {}

private:
    void* do_allocate(size_t bytes, size_t alignment) override {
        if (allocator_.allocate == nullptr) return std::pmr::new_delete_resource()->allocate(bytes, alignment);
        void* memory = allocator_.allocate(allocator_.user, bytes, alignment);
        if (memory == nullptr) throw std::bad_alloc();
        return memory;
    }
    void do_deallocate(void* memory, size_t bytes, size_t alignment) override {
        if (allocator_.release == nullptr)
            std::pmr::new_delete_resource()->deallocate(memory, bytes, alignment);
        else
            allocator_.release(allocator_.user, memory, bytes, alignment);
    }
    bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }

    BrittleAllocator allocator_;
};

} // namespace brittle::abi
