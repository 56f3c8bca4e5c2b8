// The first of all elements of a list that are the same.
#pragma once

#include "modules/brittle/fracture/recorder.h"

#include <string_view>

namespace brittle {

struct FirstsBuffers {
    engine::BufferView table;         // a hash table for them (tableSize)
    engine::BufferView slots;         // a word for each
    engine::BufferView firsts, flags; // out, a word for each: the first that is the same, and 1 for those that are the first
};

// `weld`: the kernel that says which are the same, by the words of `keys`. `count` holds the number of elements.
inline void recordFirsts(Recorder& record, std::string_view weld, uint32_t count, engine::BufferView keys,
                         const FirstsBuffers& b) {
    struct Push {
        uint32_t length, length_count, table_mask;
    } push = {0, count, static_cast<uint32_t>(b.table.size / sizeof(uint32_t)) - 1};
    record.clear({b.table});
    record.run(weld, Length::counted(count), push, {record.counts(), keys, b.table, b.slots});
    record.run("flag_firsts", Length::counted(count), count, {record.counts(), b.table, b.slots, b.firsts, b.flags});
}

} // namespace brittle
