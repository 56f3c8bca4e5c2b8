// What a context has by id. An id says what kind it is of, roughly which context made it, which place it has in the table, and
// how often that place had been used before: what is gone is told from what never was.
#pragma once

#include "modules/brittle/abi/refusal.h"

#include <cstdint>
#include <memory>
#include <memory_resource>
#include <vector>

namespace brittle::abi {

enum class Kind : uint64_t { Mesh = 1, Material = 2, World = 3, Body = 8 }; // bodies by their highest bit: they need the others

// Bits: 20 place + 1, 16 uses, 24 tag, 4 kind.
constexpr uint32_t kPlaceBits = 20, kUsesBits = 16, kTagBits = 24;

constexpr uint64_t packId(Kind kind, uint64_t tag, uint64_t uses, uint64_t place) {
    return static_cast<uint64_t>(kind) << 60 | (tag & ((1u << kTagBits) - 1)) << (kPlaceBits + kUsesBits) | uses << kPlaceBits |
           (place + 1);
}

template <class T>
class IdTable {
public:
    IdTable(Kind kind, uint64_t tag, std::pmr::memory_resource* memory)
        : kind_(kind), tag_(tag), memory_(memory), slots_(memory) {}

    // Makes one of these arguments. A place whose uses are used up is never used again.
    template <class... Arguments>
    uint64_t add(Arguments&&... arguments) {
        auto made = std::allocate_shared<T>(std::pmr::polymorphic_allocator<T>(memory_), std::forward<Arguments>(arguments)...);
        const uint64_t place = freePlace();
        slots_[place].value = std::move(made);
        return idOf(place);
    }
    T& at(uint64_t id) const { return *slots_[placeOf(id)].value; }
    std::shared_ptr<T> share(uint64_t id) const { return slots_[placeOf(id)].value; }
    void remove(uint64_t id) {
        Slot& slot = slots_[placeOf(id)];
        slot.value.reset();
        ++slot.uses;
    }
    void clear() { slots_.clear(); }

private:
    struct Slot {
        std::shared_ptr<T> value;
        uint64_t uses = 0;
    };

    uint64_t idOf(uint64_t place) const { return packId(kind_, tag_, slots_[place].uses, place); }
    uint64_t freePlace() {
        for (uint64_t place = 0; place < slots_.size(); ++place)
            if (!slots_[place].value && slots_[place].uses >> kUsesBits == 0) return place;
        if ((slots_.size() + 1) >> kPlaceBits != 0)
            throw Refusal(BRITTLE_CAPACITY, "a context has at most a million of each kind; destroy what is no longer needed");
        slots_.emplace_back();
        return slots_.size() - 1;
    }
    uint64_t placeOf(uint64_t id) const {
        const uint64_t place = (id & ((1u << kPlaceBits) - 1)) - 1, uses = id >> kPlaceBits & ((1u << kUsesBits) - 1);
        const bool known = place < slots_.size() && id == packId(kind_, tag_, uses, place) && uses <= slots_[place].uses;
        if (!known)
            throw Refusal(BRITTLE_WRONG_HANDLE, "this id was never one of a " + std::string(name()) + " of this context");
        if (uses < slots_[place].uses || !slots_[place].value)
            throw Refusal(BRITTLE_STALE_HANDLE, "this " + std::string(name()) + " has been destroyed");
        return place;
    }
    const char* name() const { return kind_ == Kind::Mesh ? "mesh" : kind_ == Kind::Material ? "material" : "world"; }

    Kind kind_;
    uint64_t tag_;
    std::pmr::memory_resource* memory_;
    std::pmr::vector<Slot> slots_;
};

} // namespace brittle::abi
