// What has become of steps that were submitted, room that is made where they did not fit, and states that are saved.
#include "modules/brittle/dynamics/device_world.h"

#include "modules/brittle/dynamics/step_failure.h"
#include "modules/brittle/fracture/fetch.h"

#include <algorithm>

namespace brittle {

using engine::BufferView;
using engine::Error;
using engine::ErrorCode;
using engine::Result;

namespace {

constexpr size_t kPairsInState = 3; // which of the lists of a state it is

} // namespace

Result<std::vector<std::byte>> DeviceWorld::save() {
    if (auto settled = settle(); !settled) return settled.error();
    return readState(device_, stateViews(), heard_);
}

Result<void> DeviceWorld::restore(std::span<const std::byte> state) {
    const auto head = headOf(state, stateViews());
    if (!head) return head.error();
    if (auto room = growFor(*head); !room) return room;
    if (auto done = writeState(device_, state, stateViews()); !done) return done;
    if (auto done = clearWord(STATUS_FAILED); !done) return done; // of a step that the state knows nothing of
    ahead_ = 0;
    strikes_.clear();
    if (striking_)
        if (auto done = striking_->forget(); !done) return done;
    heard_ = head->heard;
    fragments_.forget(); // as many may have broken in another way
    auto words = takeStock();
    return words ? Result<void>() : words.error();
}

Result<void> DeviceWorld::settle() {
    const uint64_t wanted = made_ + std::exchange(ahead_, 0);
    struct {
        uint64_t made, pairs;
    } best = {};
    for (bool is_first = true; made_ < wanted; is_first = false) {
        auto words = takeStock();
        if (!words) return words.error();
        if (const uint32_t stopped = (*words)[STATUS_STOPPED_BODY]; stopped != 0) return forget(stopped - 1);
        if (auto mended = mend(*words); !mended) return mended;
        if (!is_first && made_ <= best.made && b_.sizes.pairs <= best.pairs) return uncounted(); // it would be for ever
        best = {made_, b_.sizes.pairs};
        for (uint64_t k = made_; k < wanted; k++)
            if (auto done = submit(k); !done) return done;
    }
    strikes_.erase(strikes_.begin(), strikes_.lower_bound(made_));
    once_.clear();
    return {};
}

Result<void> DeviceWorld::mend(const std::vector<uint32_t>& words) {
    const uint32_t needed = words[STATUS_NEEDED + COUNT_BOX_PAIRS];
    const bool lacks_pairs = words[STATUS_FAILED] != 0 && needed > b_.sizes.pairs;
    const bool can_grow = budget_.pairs == 0 && needed <= mostPairs(device_);
    return lacks_pairs && can_grow ? grow(needed) : failureOf(words);
}

Result<void> DeviceWorld::grow(uint32_t needed) { return growTo(std::min(needed + needed / 2, mostPairs(device_))); }

Result<void> DeviceWorld::setPairBudget(uint32_t pairs, uint32_t contacts) {
    if (!has(Effect::Contacts)) return {};
    if (const auto settled = settle(); !settled && settled.error().code != ErrorCode::Capacity) return settled;
    const uint32_t room = pairs != 0 ? pairs : b_.sizes.pairs;
    if (room < b_.sizes.pairs || (contacts != 0 && contacts < b_.sizes.contacts))
        return Error{ErrorCode::BadInput, "a budget of " + std::to_string(pairs) + " pairs and " + std::to_string(contacts) +
                                              " contacts, there is room for " + std::to_string(b_.sizes.pairs) + " and " +
                                              std::to_string(b_.sizes.contacts) + " now; a budget can only be raised"};
    const WorldBudget before = budget_;
    const RoomToBreak broken_into = to_break_;
    budget_.pairs = pairs;
    budget_.contacts = contacts;
    to_break_.pairs = pairs;
    to_break_.contacts = contacts != 0 ? contacts : pairs;
    const auto grown = growTo(room);
    if (grown) return grown;
    budget_ = before;
    to_break_ = broken_into;
    return grown;
}

Result<void> DeviceWorld::growTo(uint32_t pairs) {
    const auto saved = readState(device_, stateViews(), heard_);
    if (!saved) return saved.error();
    if (auto made = makeRoom(pairs); !made) return made;
    if (auto done = writeState(device_, *saved, stateViews()); !done) return done;
    return record();
}

Result<void> DeviceWorld::growFor(const StateHead& state) {
    if (!has(Effect::Contacts)) return {};
    const uint64_t pairs = state.sizes[kPairsInState] / sizeof(std::array<uint32_t, 2>);
    if (pairs <= b_.sizes.pairs) return {};
    if (budget_.pairs != 0 || pairs > mostPairs(device_))
        return Error{ErrorCode::Capacity, "a state with room for " + std::to_string(pairs) +
                                              " pairs, this world has room for " + std::to_string(b_.sizes.pairs) +
                                              "; raise the budget of pairs"};
    if (auto made = makeRoom(static_cast<uint32_t>(pairs)); !made) return made;
    return record();
}

Result<void> DeviceWorld::makeRoom(uint32_t pairs) {
    auto larger = makeWorldBuffers(device_, contents_, pairs, budget_.contacts, b_.sizes.effects);
    if (!larger) return larger.error();
    std::swap(b_, *larger);
    if (breaking_)
        if (auto made = makeBreakable(to_break_); !made) {
            std::swap(b_, *larger);
            return made;
        }
    return std::exchange(drawing_, nullptr) ? makeDrawing() : Result<void>();
}

Result<std::vector<uint32_t>> DeviceWorld::takeStock() {
    std::vector<uint32_t> words(STATUS_WORDS);
    std::array<uint32_t, STEPS_WORDS> steps = {};
    const Fetch wanted[] = {{b_.counts, words.data(), 4 * words.size()}, {b_.steps, steps.data(), sizeof steps}};
    if (auto read = fetch(device_, wanted); !read) return read.error();
    if (steps[STEPS_BODIES] > b_.sizes.bodies)
        return Error{ErrorCode::Internal, "the device counts " + std::to_string(steps[STEPS_BODIES]) +
                                              " bodies and has room for " + std::to_string(b_.sizes.bodies) +
                                              "; is there a kernel that spoils its counts?"};
    made_ = steps[STEPS_MADE];
    slots_ = steps[STEPS_BODIES];
    broken_ = steps[STEPS_BROKEN];
    fragments_made_ = steps[STEPS_FRAGMENTS];
    expired_ = steps[STEPS_EXPIRED];
    return words;
}

Result<void> DeviceWorld::clearWord(uint32_t of_counts) {
    engine::Commands commands(device_);
    if (auto begun = commands.begin(); !begun) return begun;
    commands.fill(b_.counts.sub(uint64_t{4} * of_counts, 4), 0);
    return commands.submitAndWait();
}

Error DeviceWorld::uncounted() const {
    return {ErrorCode::Internal,
            "step " + std::to_string(made_ + 1) +
                " was made and neither counted nor called failed; is there a kernel that leaves out its part?"};
}

Result<void> DeviceWorld::forget(uint32_t body) {
    if (auto done = clearWord(STATUS_STOPPED_BODY); !done) return done;
    return Error{ErrorCode::BadInput, "by step " + std::to_string(made_) + " the motion of body " +
                                          std::to_string(bodyAsAdded(body)) +
                                          " is beyond what floats hold; it was stopped where it was. Smaller steps help"};
}

Result<void> DeviceWorld::failureOf(const std::vector<uint32_t>& words) const {
    return brittle::failureOf(words, b_.sizes, {made_ + 1, budget_.pairs != 0});
}

std::vector<StateView> DeviceWorld::stateViews() const {
    std::vector<StateView> views = {{b_.bodies}, {b_.steps}};
    if (!has(Effect::Contacts)) return views;
    for (const PairMemory& memory : b_.memory)
        views.insert(views.end(), {{memory.count}, {memory.pairs, true}, {memory.contacts, true}});
    if (has(Effect::Events)) views.insert(views.end(), {{b_.impacts_told}, {b_.impacts}});
    if (!breaking_) return views;
    for (const BufferView& view :
         {b_.births, b_.shapes, b_.pieces, b_.hull_records, b_.hull_vertices, b_.hull_faces, b_.hull_corners, b_.hull_edges})
        views.push_back({view});
    for (const BufferView& view : breaking_->stateViews())
        views.push_back({view});
    return views;
}

} // namespace brittle
