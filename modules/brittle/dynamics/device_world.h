// The world behind World: what it holds on the device, and what it has been told of it.
#pragma once

#include "engine/kernel_warmup.h"
#include "modules/brittle/breaking/breaking.h"
#include "modules/brittle/dynamics/body_order.h"
#include "modules/brittle/dynamics/world.h"
#include "modules/brittle/dynamics/world_state.h"

#include <map>
#include <optional>
#include <utility>

namespace brittle {

class DeviceWorld final : public World {
public:
    DeviceWorld(engine::Device& device, BodyOrder order, WorldContents contents, WorldBuffers buffers,
                const StepSettings& settings, const WorldBudget& budget)
        : device_(device), kernels_(device, shaders::all(), kernelConstants(settings, budget.group_size)),
          order_(std::move(order)), contents_(std::move(contents)), b_(std::move(buffers)), settings_(settings),
          budget_(budget), slots_(static_cast<uint32_t>(order_.body_at.size())) {}
    // Bodies that can, break from now on; to be called before anything is recorded.
    engine::Result<void> makeBreakable(const RoomToBreak& room);
    // Once for each of the two memories that take turns. What was recorded before stays where that fails.
    engine::Result<void> record();

    engine::Result<void> step(uint32_t steps) override;
    engine::Result<void> advance(uint32_t steps) override;
    engine::Result<void> setPairBudget(uint32_t pairs, uint32_t contacts) override;
    engine::Result<void> recordSteps(VkCommandBuffer commands, uint32_t steps) override;
    engine::Result<void> strike(const HandBlow& blow) override;

    engine::Result<DrawBuffers> drawBuffers() override;
    engine::Result<void> recordDraws(VkCommandBuffer commands, const Double3& origin) override;
    engine::Result<void> updateDraws(const Double3& origin) override;

    engine::Result<std::vector<gpu::BodyState>> bodies() override;
    engine::Result<std::vector<BodyFragment>> fragments() override;
    engine::Result<std::vector<SurfaceMesh>> surfacesOf(std::span<const BodyFragment> fragments) override;
    engine::Result<WorldCounts> counts() override;
    engine::Result<Dust> dust() override;
    engine::Result<Breaks> breaks() override;
    engine::Result<Impacts> impacts() override;
    engine::Result<std::vector<std::array<uint32_t, 2>>> pairs() override;
    engine::Result<std::vector<engine::Timing>> timings() override;

    // Of the first step; the second is the same with the two memories of contacts exchanged. Recorded and not submitted.
    engine::Result<StepPlan> plan() override;
    engine::Result<std::vector<double>> measure(uint32_t steps) override;
    engine::Result<void> probeStep(PassProbe& probe) override;
    engine::Result<void> timeKernels(bool on) override;
    engine::KernelLibrary& kernels() override { return kernels_; }
    engine::Result<void> kernelsChanged() override;
    uint32_t dispatches() const override { return commands_[0]->dispatchCount(); }

    engine::Result<std::vector<std::byte>> save() override;
    engine::Result<void> restore(std::span<const std::byte> state) override;
    engine::Result<uint64_t> hash() override;

private:
    // `by_hand`: nullptr for a step without blows by hand.
    engine::Result<void> recordInto(engine::Commands& commands, uint32_t parity, const HandBlows* by_hand = nullptr);
    engine::Result<void> recordStep(Recorder& record, uint32_t parity, const HandBlows* by_hand = nullptr);
    bool bounce() const;
    // Makes what blows by hand need, and records the steps again: before the first blow.
    engine::Result<void> prepareStrikes();
    // By its number, counted from 0.
    engine::Result<void> submit(uint64_t step);
    engine::Result<void> submitOnce(uint32_t parity, const HandBlows& by_hand);
    engine::Result<void> recordForOthers(std::unique_ptr<engine::Commands>& recording, uint64_t step);

    // Finds out what has become of steps that were submitted. Where one did not fit, none after it was made: with more room
    // they are made now.
    engine::Result<void> settle();
    engine::Result<void> mend(const std::vector<uint32_t>& words);

    // Fragments keep their slots.
    uint32_t bodyAsAdded(uint32_t slot) const { return slot < order_.body_at.size() ? order_.body_at[slot] : slot; }
    uint32_t pieceAsAdded(uint32_t slot) const { return slot < order_.piece_at.size() ? order_.piece_at[slot] : slot; }
    // In the order that the device has them in.
    engine::Result<std::vector<gpu::BodyState>> readStates();
    engine::Result<void> countPools(WorldCounts& c);
    engine::Result<void> makeDrawing();

    // Room for more pairs than that, and everything as it was.
    engine::Result<void> grow(uint32_t needed);
    // A state of when there was more room than there is now.
    engine::Result<void> growFor(const StateHead& state);
    // Room for so many pairs, and everything as it was.
    engine::Result<void> growTo(uint32_t pairs);
    // All anew, as it was in the beginning.
    engine::Result<void> makeRoom(uint32_t pairs);

    // How many steps the device has made; the counts of the last.
    engine::Result<std::vector<uint32_t>> takeStock();
    engine::Result<void> clearWord(uint32_t of_counts);
    // That a body was stopped is told once.
    engine::Error uncounted() const;
    engine::Result<void> forget(uint32_t body);
    engine::Result<void> failureOf(const std::vector<uint32_t>& words) const;
    std::vector<StateView> stateViews() const;
    PlannedMemory memory() const;
    // Buffers whose contents a step makes before it reads them.
    std::vector<engine::BufferView> stepMemory() const;
    engine::Result<std::vector<double>> mediansOf(uint32_t steps);
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
    std::unique_ptr<engine::Commands> by_others_[2]; // for command buffers of others, once they ask for it
    std::vector<std::unique_ptr<engine::Commands>>
        once_;                              // the same of steps with blows by hand, and of steps recorded anew since
    std::map<uint64_t, HandBlows> strikes_; // by step, until it is known to have been made
    bool times_passes_ = false;
    uint64_t made_ = 0;
    uint64_t ahead_ = 0;                 // steps that were submitted since that was read
    std::unique_ptr<Breaking> breaking_; // where bodies break
    std::unique_ptr<Strikes> striking_;  // once a host has struck
    RoomToBreak to_break_;
    HeardSoFar heard_;
    uint32_t slots_ = 0; // of bodies, that have ever held one
    uint32_t broken_ = 0, fragments_made_ = 0, expired_ = 0;
    FragmentList fragments_;
    std::unique_ptr<Drawing> drawing_; // once somebody draws
    uint32_t drawings_ = 0;
    std::optional<engine::LateWarmup> warmup_; // while the first step runs
};

} // namespace brittle
