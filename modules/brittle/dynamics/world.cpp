#include "modules/brittle/dynamics/world.h"

#include "modules/brittle/breaking/breaking.h"
#include "modules/brittle/dynamics/body_order.h"
#include "modules/brittle/dynamics/step.h"
#include "modules/brittle/dynamics/step_failure.h"
#include "modules/brittle/dynamics/world_state.h"
#include "modules/brittle/fracture/fetch.h"
#include "modules/brittle/fracture/group_size.h"
#include "modules/brittle/fracture/upload.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace brittle {
namespace {

using engine::BufferView;
using engine::Error;
using engine::ErrorCode;
using engine::Result;

constexpr size_t kPairsInState = 3;                        // which of the lists of a state it is
constexpr uint32_t kPairsPerPiece = 9, kLeastPairs = 1024; // as piles have them; there is more room made where it is needed

uint64_t hashOf(std::span<const std::byte> bytes) {
    uint64_t hash = 0xcbf29ce484222325u; // FNV-1a
    for (const std::byte b : bytes)
        hash = (hash ^ static_cast<uint64_t>(b)) * 0x100000001b3u;
    return hash;
}

class DeviceWorld : public World {
public:
    DeviceWorld(engine::Device& device, BodyOrder order, WorldContents contents, WorldBuffers buffers,
                const StepSettings& settings, const WorldBudget& budget)
        : device_(device), kernels_(device, shaders::all(), kernelConstants(settings, budget.group_size)),
          order_(std::move(order)), contents_(std::move(contents)), b_(std::move(buffers)), settings_(settings),
          budget_(budget), slots_(static_cast<uint32_t>(order_.body_at.size())) {}

    // Bodies that can, break from now on; to be called before anything is recorded.
    Result<void> makeBreakable(const RoomToBreak& room) {
        auto breaking = Breaking::create(device_, contents_, room, settings_, b_.sizes, budget_.group_size);
        if (!breaking) return breaking.error();
        breaking_ = std::move(*breaking);
        to_break_ = room;
        return {};
    }

    // Once for each of the two memories that take turns. What was recorded before stays where that fails.
    Result<void> record() {
        std::unique_ptr<engine::Commands> recorded[2];
        for (uint32_t parity = 0; parity < 2; parity++) {
            recorded[parity] = std::make_unique<engine::Commands>(device_);
            engine::Commands& commands = *recorded[parity];
            if (auto begun = commands.begin(engine::Commands::Reuse::Many); !begun) return begun;
            if (times_passes_) commands.timeKernels();
            if (auto done = recordInto(commands, parity); !done) return done;
        }
        for (uint32_t parity = 0; parity < 2; parity++) {
            commands_[parity] = std::move(recorded[parity]);
            submitted_[parity] = false;
            by_others_[parity].reset();
        }
        return {};
    }

    Result<void> step(uint32_t steps) override {
        if (auto done = advance(steps); !done) return done;
        return settle();
    }

    Result<void> advance(uint32_t steps) override {
        for (uint32_t k = 0; k < steps; ++k, ++ahead_)
            if (auto done = submit(made_ + ahead_); !done) return done;
        return {};
    }

    Result<void> recordSteps(VkCommandBuffer commands, uint32_t steps) override {
        for (uint32_t k = 0; k < steps; ++k, ++ahead_) {
            const uint64_t step = made_ + ahead_;
            auto& recording = strikes_.contains(step) ? once_.emplace_back() : by_others_[step & 1];
            if (!recording)
                if (auto recorded = recordForOthers(recording, step); !recorded) return recorded;
            recording->executeIn(commands);
        }
        return {};
    }

    Result<void> strike(const HandBlow& blow) override {
        if (auto sound = checkBlow(blow); !sound) return sound;
        if (!breaking_)
            return Error{ErrorCode::BadInput,
                         "nothing in this world can break: it needs the effect impact_fracture, and bodies "
                         "of a material"};
        auto& blows = strikes_[made_ + ahead_];
        if (blows.size() == MOST_STRIKES)
            return Error{ErrorCode::Capacity, "a step takes " + std::to_string(MOST_STRIKES) +
                                                  " blows by hand; make a step, or let one blow reach further"};
        blows.push_back(blow);
        return {};
    }

    Result<DrawBuffers> drawBuffers() override {
        if (auto made = makeDrawing(); !made) return made.error();
        return drawing_->buffers();
    }

    Result<void> recordDraws(VkCommandBuffer commands, const Double3& origin) override {
        if (auto sound = checkOrigin(origin); !sound) return sound;
        if (auto made = makeDrawing(); !made) return made;
        drawing_->record(commands, origin);
        return {};
    }

    Result<void> updateDraws(const Double3& origin) override {
        if (auto sound = checkOrigin(origin); !sound) return sound;
        if (auto settled = settle(); !settled) return settled;
        if (auto made = makeDrawing(); !made) return made;
        return drawing_->update(origin);
    }

    Result<std::vector<gpu::BodyState>> bodies() override {
        if (auto settled = settle(); !settled) return settled.error();
        auto states = readStates();
        if (!states) return states;
        std::vector<gpu::BodyState> as_added = *states;
        for (size_t k = 0; k < order_.body_at.size(); k++)
            as_added[order_.body_at[k]] = (*states)[k];
        return as_added;
    }

    Result<std::vector<BodyFragment>> fragments() override {
        if (auto settled = settle(); !settled) return settled.error();
        if (!breaking_) return std::vector<BodyFragment>();
        auto read = fragments_.read(device_, breaking_->breakable(), b_.births, slots_, broken_ + expired_);
        if (!read) return read;
        const auto fades = breaking_->fades(slots_);
        if (!fades) return fades.error();
        for (BodyFragment& fragment : *read) {
            fragment.fade = (*fades)[fragment.slot];
            fragment.slot = bodyAsAdded(fragment.slot);
            fragment.origin = bodyAsAdded(fragment.origin);
            fragment.parent = bodyAsAdded(fragment.parent);
        }
        return read;
    }

    Result<std::vector<SurfaceMesh>> surfacesOf(std::span<const BodyFragment> fragments) override {
        if (fragments.empty()) return std::vector<SurfaceMesh>();
        return readSurfaces(device_, breaking_->surfaceVertices(), fragments);
    }

    Result<WorldCounts> counts() override {
        if (auto settled = settle(); !settled) return settled.error();
        std::vector<uint32_t> words(STATUS_WORDS), args(9 * COUNT_TOTAL), colors(COLOR_WORDS);
        std::vector<Fetch> wanted = {{b_.counts, words.data(), 4 * words.size()}, {b_.args, args.data(), 4 * args.size()}};
        if (has(Effect::Contacts)) wanted.push_back({b_.step.color_start, colors.data(), 4 * colors.size()});
        std::vector<uint32_t> breaking_args(breaking_ ? 9 * COUNT_TOTAL : 0);
        if (breaking_) wanted.push_back({breaking_->arguments(), breaking_args.data(), 4 * breaking_args.size()});
        if (auto read = fetch(device_, wanted); !read) return read.error();
        WorldCounts c = {slots_, b_.sizes.pieces, words[COUNT_BOX_PAIRS], words[COUNT_CONTACTS], words[COUNT_FRESH_PAIRS]};
        for (uint32_t k = COUNT_BOX_PAIRS; k <= COUNT_SOLVED_APART; k++)
            c.groups += args[9 * k] * args[9 * k + 1];
        for (size_t k = 0; k < breaking_args.size(); k += 9)
            c.breaking_groups += breaking_args[k] * breaking_args[k + 1];
        c.colors = words[COUNT_CONTACTS] == 0 ? 0 : colors[COLORS_USED];
        c.awake = has(Effect::Sleeping) ? words[COUNT_AWAKE] : b_.movers + fragments_made_ - broken_ - expired_;
        c.colorless = words[COUNT_CONTACTS] == 0 ? 0 : colors[COLORS_LACKED];
        c.broken = broken_;
        c.fragments = fragments_made_;
        c.expired = expired_;
        if (auto counted = countPools(c); !counted) return counted.error();
        return c;
    }

    Result<Dust> dust() override {
        if (auto settled = settle(); !settled) return settled.error();
        if (!breaking_) return Dust();
        auto dust = breaking_->dust();
        if (!dust) return dust;
        for (gpu::DustParticle& particle : dust->flying)
            particle.birth.y = bodyAsAdded(particle.birth.y);
        return dust;
    }

    Result<Breaks> breaks() override {
        if (auto settled = settle(); !settled) return settled.error();
        if (!breaking_ || !has(Effect::Events)) return Breaks();
        auto told = breaking_->tell(heard_.breaks);
        if (!told) return told.error();
        for (gpu::BreakEvent& event : told->events)
            for (uint32_t* body : {&event.what.y, &event.what.z, &event.born.z, &event.born.w})
                *body = bodyAsAdded(*body);
        return told;
    }

    Result<Impacts> impacts() override {
        if (auto settled = settle(); !settled) return settled.error();
        if (!has(Effect::Contacts) || !has(Effect::Events)) return Impacts();
        auto told = hear<gpu::ImpactEvent>(device_, b_.impacts_told, b_.impacts, heard_.impacts);
        if (!told) return told.error();
        for (gpu::ImpactEvent& event : told->events)
            for (uint32_t* body : {&event.what.y, &event.what.z, &event.born.z, &event.born.w})
                *body = bodyAsAdded(*body);
        return told;
    }

    Result<std::vector<std::array<uint32_t, 2>>> pairs() override {
        auto counted = counts();
        if (!counted) return counted.error();
        std::vector<std::array<uint32_t, 2>> pairs(counted->pairs);
        if (pairs.empty()) return pairs;
        const Fetch wanted[] = {{b_.memory[(made_ + 1) & 1].pairs.sub(0, 8 * pairs.size()), pairs.data(), 8 * pairs.size()}};
        if (auto read = fetch(device_, wanted); !read) return read.error();
        for (auto& pair : pairs) {
            const uint32_t a = pieceAsAdded(pair[0]), b = pieceAsAdded(pair[1]);
            pair = {std::min(a, b), std::max(a, b)};
        }
        std::ranges::sort(pairs);
        return pairs;
    }

    Result<std::vector<engine::Timing>> timings() override {
        if (auto settled = settle(); !settled) return settled.error();
        return commands_[(made_ + 1) & 1]->timings();
    }
    // Of the first step; the second is the same with the two memories of contacts exchanged. Recorded and not submitted.
    Result<StepPlan> plan() override {
        engine::Commands commands(device_);
        if (auto begun = commands.begin(); !begun) return begun.error();
        commands.keepTrace();
        Recorder recorder(commands, kernels_, b_.counts, b_.args);
        if (auto recorded = recordStep(recorder, 0); !recorded) return recorded.error();
        if (auto recorded = recorder.status(); !recorded) return recorded.error();
        return planOf(commands.trace(), memory(), kernels_.kernelNames());
    }

    Result<std::vector<double>> measure(uint32_t steps) override {
        const bool before = std::exchange(times_passes_, true);
        auto recorded = record();
        auto medians = recorded ? mediansOf(steps) : Result<std::vector<double>>(recorded.error());
        times_passes_ = before;
        if (recorded = record(); !recorded) return recorded.error();
        return medians;
    }

    Result<void> timeKernels(bool on) override {
        if (auto settled = settle(); !settled) return settled;
        times_passes_ = on;
        return record();
    }

    engine::KernelLibrary& kernels() override { return kernels_; }

    Result<void> kernelsChanged() override {
        const auto settled = settle();
        if (auto recorded = record(); !recorded) return recorded;
        if (drawing_)
            if (auto recorded = drawing_->recordAgain(); !recorded) return recorded;
        return settled;
    }

    uint32_t dispatches() const override { return commands_[0]->dispatchCount(); }

    Result<std::vector<std::byte>> save() override {
        if (auto settled = settle(); !settled) return settled.error();
        return readState(device_, stateViews(), heard_);
    }

    Result<void> restore(std::span<const std::byte> state) override {
        const auto head = headOf(state, stateViews());
        if (!head) return head.error();
        if (auto room = growFor(*head); !room) return room;
        if (auto done = writeState(device_, state, stateViews()); !done) return done;
        if (auto done = clearWord(STATUS_FAILED); !done) return done; // of a step that the state knows nothing of
        ahead_ = 0;
        strikes_.clear();
        heard_ = head->heard;
        fragments_.forget(); // as many may have broken in another way
        auto words = takeStock();
        return words ? Result<void>() : words.error();
    }

    Result<uint64_t> hash() override {
        if (auto settled = settle(); !settled) return settled.error();
        const auto states = readStates();
        if (!states) return states.error();
        return hashOf(std::as_bytes(std::span(*states)));
    }

private:
    // `blows`: by hand; nullptr for a step without, which has nothing of it.
    Result<void> recordInto(engine::Commands& commands, uint32_t parity, const std::vector<HandBlow>* blows = nullptr) {
        Recorder recorder(commands, kernels_, b_.counts, b_.args);
        if (auto recorded = recordStep(recorder, parity, blows); !recorded) return recorded;
        return recorder.status();
    }

    Result<void> recordStep(Recorder& record, uint32_t parity, const std::vector<HandBlow>* blows = nullptr) {
        if (blows != nullptr && has(Effect::Sleeping)) record.commands().fill(b_.steps.sub(4 * STEPS_ASLEEP, 4), 0);
        const Step step = {settings_, b_,     b_.memory[1 - parity], b_.memory[parity],
                           kernels_,  record, hasManyLanes(device_), has(Effect::Restitution) && bounce()};
        record.clear({b_.counts.sub(0, 4 * STATUS_FAILED)});
        recordBoxes(step);
        if (auto recorded = recordContacts(step); !recorded) return recorded;
        if (blows != nullptr)
            if (auto struck = breaking_->recordStrikes(step, *blows); !struck) return struck;
        recordIslands(step);
        if (breaking_)
            if (auto recorded = breaking_->recordBlows(step, blows != nullptr); !recorded) return recorded;
        recordColors(step);
        if (breaking_) breaking_->recordAdmission(step, blows != nullptr);
        recordSolve(step);
        recordImpacts(step, breaking_ ? std::optional(breaking_->breakable()) : std::nullopt);
        recordEnd(step);
        if (breaking_) return breaking_->recordEvent(step);
        return {};
    }

    Result<void> countPools(WorldCounts& c) {
        if (!breaking_) return {};
        const auto pools = breaking_->pools();
        if (!pools) return pools.error();
        for (size_t k = 0; k < pools->size(); k++) {
            c.in_use[k] = (*pools)[k].in_use;
            c.pool_faults |= (*pools)[k].status;
        }
        return {};
    }

    Result<std::vector<double>> mediansOf(uint32_t steps) {
        std::vector<std::vector<double>> times; // of each dispatch
        for (uint32_t k = 0; k < std::max(steps, 1u); k++) {
            if (auto done = step(1); !done) return done.error();
            const auto spans = commands_[(made_ + 1) & 1]->spanTimes();
            if (!spans) return spans.error();
            times.resize(spans->size()); // of a queue without timestamps there are none
            for (size_t pass = 0; pass < times.size(); pass++)
                times[pass].push_back(1000 * (*spans)[pass]);
        }
        std::vector<double> medians;
        for (std::vector<double>& of_pass : times) {
            const auto middle = of_pass.begin() + static_cast<ptrdiff_t>(of_pass.size() / 2);
            std::ranges::nth_element(of_pass, middle);
            medians.push_back(*middle);
        }
        return medians;
    }

    bool bounce() const {
        return std::ranges::any_of(contents_.shapes, [](const auto& shape) { return shape.inverse_inertia[1].w > 0; });
    }

    // By its number, counted from 0.
    Result<void> submit(uint64_t step) {
        const uint32_t parity = step & 1;
        if (const auto blows = strikes_.find(step); blows != strikes_.end()) return submitOnce(parity, blows->second);
        engine::Commands& commands = *commands_[parity];
        if (auto submitted = submitted_[parity] ? commands.submitAgain() : commands.submit(); !submitted) return submitted;
        submitted_[parity] = true;
        return commands.wait();
    }

    Result<void> submitOnce(uint32_t parity, const std::vector<HandBlow>& blows) {
        engine::Commands commands(device_);
        if (auto begun = commands.begin(); !begun) return begun;
        if (auto recorded = recordInto(commands, parity, &blows); !recorded) return recorded;
        return commands.submitAndWait();
    }

    Result<void> recordForOthers(std::unique_ptr<engine::Commands>& recording, uint64_t step) {
        auto commands = std::make_unique<engine::Commands>(device_);
        if (auto begun = commands->begin(engine::Commands::Reuse::ByOthers); !begun) return begun;
        const auto blows = strikes_.find(step);
        const auto* by_hand = blows != strikes_.end() ? &blows->second : nullptr;
        if (auto recorded = recordInto(*commands, step & 1, by_hand); !recorded) return recorded;
        if (auto ended = commands->end(); !ended) return ended;
        recording = std::move(commands);
        return {};
    }

    static Result<void> checkOrigin(const Double3& origin) {
        constexpr double kFarthest = 1e6; // m
        for (const double x : origin)
            if (!(std::abs(x) <= kFarthest))
                return Error{ErrorCode::BadInput,
                             "the place that is drawn from has to be numbers, and no further out than 1e6 m"};
        return {};
    }

    Result<void> makeDrawing() {
        if (drawing_) return {};
        Drawing::Source source = {.bodies = b_.bodies, .slots = b_.sizes.bodies, .as_added = order_.body_at};
        if (breaking_) {
            source.breakable = breaking_->breakable();
            source.vertices = breaking_->surfaceVertices();
            source.clocks = breaking_->clocks();
            source.fades_after = static_cast<float>(settings_.debris_after);
            source.fade_duration = static_cast<float>(settings_.debris_fade);
        }
        auto made = Drawing::create(device_, kernels_, contents_, std::move(source), ++drawings_);
        if (!made) return made.error();
        drawing_ = std::move(*made);
        return {};
    }

    // Finds out what has become of steps that were submitted. Where one did not fit, none after it was made: with more room
    // they are made now.
    Result<void> settle() {
        const uint64_t wanted = made_ + std::exchange(ahead_, 0);
        while (made_ < wanted) {
            auto words = takeStock();
            if (!words) return words.error();
            if (const uint32_t stopped = (*words)[STATUS_STOPPED_BODY]; stopped != 0) return forget(stopped - 1);
            if (auto mended = mend(*words); !mended) return mended;
            for (uint64_t k = made_; k < wanted; k++)
                if (auto done = submit(k); !done) return done;
        }
        strikes_.erase(strikes_.begin(), strikes_.lower_bound(made_));
        once_.clear();
        return {};
    }

    Result<void> mend(const std::vector<uint32_t>& words) {
        const uint32_t needed = words[STATUS_NEEDED + COUNT_BOX_PAIRS];
        const bool lacks_pairs = words[STATUS_FAILED] != 0 && needed > b_.sizes.pairs;
        const bool can_grow = budget_.pairs == 0 && needed <= mostPairs(device_);
        return lacks_pairs && can_grow ? grow(needed) : failureOf(words);
    }

    // Fragments keep their slots.
    uint32_t bodyAsAdded(uint32_t slot) const { return slot < order_.body_at.size() ? order_.body_at[slot] : slot; }
    uint32_t pieceAsAdded(uint32_t slot) const { return slot < order_.piece_at.size() ? order_.piece_at[slot] : slot; }

    // In the order that the device has them in.
    Result<std::vector<gpu::BodyState>> readStates() {
        std::vector<gpu::BodyState> states(slots_);
        const Fetch wanted[] = {{b_.bodies, states.data(), states.size() * sizeof(gpu::BodyState)}};
        if (auto read = fetch(device_, wanted); !read) return read.error();
        return states;
    }

    // Room for more pairs than that, and everything as it was.
    Result<void> grow(uint32_t needed) {
        const auto saved = readState(device_, stateViews(), heard_);
        if (!saved) return saved.error();
        if (auto made = makeRoom(std::min(needed + needed / 2, mostPairs(device_))); !made) return made;
        if (auto done = writeState(device_, *saved, stateViews()); !done) return done;
        return record();
    }

    // A state of when there was more room than there is now.
    Result<void> growFor(const StateHead& state) {
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

    // All anew, as it was in the beginning.
    Result<void> makeRoom(uint32_t pairs) {
        auto larger = makeWorldBuffers(device_, contents_, pairs, budget_.contacts, b_.sizes.effects);
        if (!larger) return larger.error();
        std::swap(b_, *larger);
        if (breaking_)
            if (auto made = makeBreakable(to_break_); !made) return made;
        return std::exchange(drawing_, nullptr) ? makeDrawing() : Result<void>();
    }

    // How many steps the device has made; the counts of the last.
    Result<std::vector<uint32_t>> takeStock() {
        std::vector<uint32_t> words(STATUS_WORDS);
        std::array<uint32_t, STEPS_WORDS> steps = {};
        const Fetch wanted[] = {{b_.counts, words.data(), 4 * words.size()}, {b_.steps, steps.data(), sizeof steps}};
        if (auto read = fetch(device_, wanted); !read) return read.error();
        made_ = steps[STEPS_MADE];
        slots_ = steps[STEPS_BODIES];
        broken_ = steps[STEPS_BROKEN];
        fragments_made_ = steps[STEPS_FRAGMENTS];
        expired_ = steps[STEPS_EXPIRED];
        return words;
    }

    Result<void> clearWord(uint32_t of_counts) {
        engine::Commands commands(device_);
        if (auto begun = commands.begin(); !begun) return begun;
        commands.fill(b_.counts.sub(uint64_t{4} * of_counts, 4), 0);
        return commands.submitAndWait();
    }

    // That a body was stopped is told once.
    Result<void> forget(uint32_t body) {
        if (auto done = clearWord(STATUS_STOPPED_BODY); !done) return done;
        return Error{ErrorCode::BadInput, "by step " + std::to_string(made_) + " the motion of body " +
                                              std::to_string(bodyAsAdded(body)) +
                                              " is beyond what floats hold; it was stopped where it was. Smaller steps help"};
    }

    Result<void> failureOf(const std::vector<uint32_t>& words) const {
        return brittle::failureOf(words, b_.sizes, {made_ + 1, budget_.pairs != 0});
    }

    std::vector<StateView> stateViews() const {
        std::vector<StateView> views = {{b_.bodies}, {b_.steps}};
        if (!has(Effect::Contacts)) return views;
        for (const PairMemory& memory : b_.memory)
            views.insert(views.end(), {{memory.count}, {memory.pairs, true}, {memory.contacts, true}});
        if (has(Effect::Events)) views.insert(views.end(), {{b_.impacts_told}, {b_.impacts}});
        if (!breaking_) return views;
        for (const BufferView& view : {b_.births, b_.shapes, b_.pieces, b_.hull_records, b_.hull_vertices, b_.hull_faces,
                                       b_.hull_corners, b_.hull_edges})
            views.push_back({view});
        for (const BufferView& view : breaking_->stateViews())
            views.push_back({view});
        return views;
    }
    PlannedMemory memory() const {
        PlannedMemory memory = {b_.sizes.effects, b_.named, b_.args, {}};
        if (!breaking_) return memory;
        std::ranges::copy(breaking_->buffers(), std::back_inserter(memory.named));
        memory.fracture_args = breaking_->arguments();
        return memory;
    }
    bool has(Effect effect) const { return b_.sizes.effects.has(effect); }

    engine::Device& device_;
    engine::KernelLibrary kernels_;
    BodyOrder order_;
    WorldContents contents_; // in that order, to be made anew with more room
    WorldBuffers b_;
    StepSettings settings_;
    WorldBudget budget_;
    std::unique_ptr<engine::Commands> commands_[2];
    bool submitted_[2] = {false, false};
    std::unique_ptr<engine::Commands> by_others_[2];      // for command buffers of others, once they ask for it
    std::vector<std::unique_ptr<engine::Commands>> once_; // the same of steps with blows by hand
    std::map<uint64_t, std::vector<HandBlow>> strikes_;   // by step, until it is known to have been made
    bool times_passes_ = false;
    uint64_t made_ = 0;
    uint64_t ahead_ = 0;                 // steps that were submitted since that was read
    std::unique_ptr<Breaking> breaking_; // where bodies break
    RoomToBreak to_break_;
    HeardSoFar heard_;
    uint32_t slots_ = 0; // of bodies, that have ever held one
    uint32_t broken_ = 0, fragments_made_ = 0, expired_ = 0;
    FragmentList fragments_;
    std::unique_ptr<Drawing> drawing_; // once somebody draws
    uint32_t drawings_ = 0;
};

// Where bodies of theirs may break, gives the contents slots for what they break into; else nothing.
Result<std::optional<RoomToBreak>> makeRoomToBreak(WorldContents& contents, const StepSettings& settings,
                                                   const WorldBudget& budget) {
    if (!effectsOf(settings).has(Effect::ImpactFracture) || contents.breakable.empty()) return std::optional<RoomToBreak>();
    auto room = roomToBreak(contents, budget.breaking);
    if (!room) return room.error();
    room->pairs = budget.pairs;
    room->contacts = budget.contacts != 0 ? budget.contacts : budget.pairs;
    contents = withRoom(contents, *room);
    return std::optional(std::move(*room));
}

} // namespace

Result<std::unique_ptr<World>> World::create(engine::Device& device, const WorldContents& contents,
                                             const StepSettings& settings, const WorldBudget& budget) {
    if (auto sound = checkSettings(settings); !sound) return sound.error();
    const uint32_t group_size = budget.group_size == 0 ? GROUP_SIZE : budget.group_size;
    if (auto sound = checkGroupSize(group_size, device.limits()); !sound) return sound.error();
    if (contents.bodies.empty()) return Error{ErrorCode::BadInput, "a world without bodies; add at least one"};
    BodyOrder order = orderById(contents);
    WorldContents sorted = inOrder(contents, order);
    const auto to_break = makeRoomToBreak(sorted, settings, budget);
    if (!to_break) return to_break.error();
    const uint64_t chosen =
        std::max<uint64_t>({kLeastPairs, uint64_t{kPairsPerPiece} * sorted.pieces.size(), 2 * sorted.siblings.size()});
    const auto room = budget.pairs != 0 ? budget.pairs : static_cast<uint32_t>(std::min<uint64_t>(chosen, mostPairs(device)));
    auto buffers = makeWorldBuffers(device, sorted, room, budget.contacts, effectsOf(settings));
    if (!buffers) return buffers.error();
    WorldBudget given = budget;
    given.group_size = group_size;
    auto world =
        std::make_unique<DeviceWorld>(device, std::move(order), std::move(sorted), std::move(*buffers), settings, given);
    if (*to_break)
        if (auto made = world->makeBreakable(**to_break); !made) return made.error();
    if (auto recorded = world->record(); !recorded) return recorded.error();
    return std::unique_ptr<World>(std::move(world));
}

} // namespace brittle
