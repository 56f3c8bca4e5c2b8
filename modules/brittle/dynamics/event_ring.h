// Rings on the device, in which the host is told of what has happened.
#pragma once

#include "modules/brittle/fracture/fetch.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace brittle {

template <class Event>
struct HeardEvents {
    std::vector<Event> events; // the oldest first
    uint32_t lost = 0;         // overwritten before anybody asked
};

// What has come since `heard`, which is brought up to now. `told`: one word, how many there have been; `ring`: the last so many
// of them that it holds. Reads these and no others.
template <class Event>
engine::Result<HeardEvents<Event>> hear(engine::Device& device, const engine::BufferView& told, const engine::BufferView& ring,
                                        uint32_t& heard) {
    uint32_t now = 0;
    const Fetch count[] = {{told.sub(0, 4), &now, 4}};
    if (auto read = fetch(device, count); !read) return read.error();
    const auto room = static_cast<uint32_t>(ring.size / sizeof(Event));
    const uint32_t fresh = now - heard, kept = std::min(fresh, room), first = (now - kept) % room;
    HeardEvents<Event> answer{std::vector<Event>(kept), fresh - kept};
    if (kept == 0) {
        heard = now;
        return answer;
    }
    const uint32_t before_end = std::min(kept, room - first);
    const auto piece = [&](uint32_t at, uint32_t from, uint32_t length) {
        return Fetch{ring.sub(from * sizeof(Event), length * sizeof(Event)), answer.events.data() + at, length * sizeof(Event)};
    };
    std::vector<Fetch> wanted = {piece(0, first, before_end)};
    if (before_end < kept) wanted.push_back(piece(before_end, 0, kept - before_end));
    if (auto read = fetch(device, wanted); !read) return read.error();
    heard = now; // all of it is there
    return answer;
}

} // namespace brittle
