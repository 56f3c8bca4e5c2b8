#include "modules/brittle/comparison/world_comparison.h"

#include <algorithm>
#include <array>

namespace brittle {
namespace {

using engine::Error;
using engine::ErrorCode;
using engine::Result;
using State = std::vector<std::byte>;

constexpr uint32_t kBetweenStates = 8; // steps

// A world that can go back some steps.
class TracedWorld {
public:
    TracedWorld(ComparedWorld compared, std::string name) : compared_(compared), name_(std::move(name)) {}

    ComparedWorld compared() const { return compared_; }
    Result<void> step() {
        if (keeps_ && made_ % kBetweenStates == 0)
            if (auto kept = keep(); !kept) return kept;
        ++made_;
        return named(compared_.world.step());
    }
    Result<uint64_t> hash() { return named(compared_.world.hash()); }
    Result<std::vector<gpu::BodyState>> bodies() { return named(compared_.world.bodies()); }
    // Keeps no states of later steps: none of them will be repeated.
    void stopKeeping() { keeps_ = false; }
    // The first step that can be gone back to, a number from 1.
    uint32_t firstStep() const { return kept_[0].before + 1; }
    // The state before a step with a number from firstStep() on. Leaves the world there.
    Result<State> stateBefore(uint32_t step) {
        const Kept& from = kept_[1].is_there() && kept_[1].before < step ? kept_[1] : kept_[0];
        if (auto restored = named(compared_.world.restore(from.state)); !restored) return restored.error();
        for (uint32_t k = from.before; k + 1 < step; ++k)
            if (auto stepped = named(compared_.world.step()); !stepped) return stepped.error();
        return named(compared_.world.save());
    }

private:
    struct Kept {
        uint32_t before = 0; // steps made before
        State state;
        bool is_there() const { return !state.empty(); }
    };
    Result<void> keep() {
        auto saved = named(compared_.world.save());
        if (!saved) return saved.error();
        if (kept_[1].is_there()) kept_[0] = std::move(kept_[1]);
        (kept_[0].is_there() ? kept_[1] : kept_[0]) = Kept{made_, std::move(*saved)};
        return {};
    }
    template <class T>
    Result<T> named(Result<T> result) const {
        if (result) return result;
        return Error{result.error().code, name_ + ": " + result.error().message};
    }

    ComparedWorld compared_;
    std::string name_;
    uint32_t made_ = 0;
    bool keeps_ = true;
    std::array<Kept, 2> kept_;
};

class WorldComparer {
public:
    WorldComparer(ComparedWorld a, ComparedWorld b, const ComparisonOptions& options)
        : a_(a, "device A"), b_(b, "device B"), options_(options) {}

    Result<WorldComparison> run() {
        if (auto stepped = stepBoth(); !stepped) return stepped.error();
        if (auto measured = measureMotion(); !measured) return measured.error();
        if (found_.first_difference)
            if (auto traced = trace(); !traced) return traced.error();
        return std::move(found_);
    }

private:
    Result<void> stepBoth() {
        while (found_.steps < options_.steps && (!found_.first_difference || options_.whole)) {
            if (options_.progress) options_.progress(found_.steps + 1);
            for (TracedWorld* world : {&a_, &b_})
                if (auto stepped = world->step(); !stepped) return stepped;
            ++found_.steps;
            if (!found_.first_difference)
                if (auto looked = lookForDifference(); !looked) return looked;
        }
        return {};
    }
    Result<void> lookForDifference() {
        const auto hash_a = a_.hash(), hash_b = b_.hash();
        if (!hash_a) return hash_a.error();
        if (!hash_b) return hash_b.error();
        if (*hash_a == *hash_b) return {};
        found_.first_difference = found_.steps;
        for (TracedWorld* world : {&a_, &b_})
            world->stopKeeping();
        const auto bodies_a = a_.bodies(), bodies_b = b_.bodies();
        if (!bodies_a) return bodies_a.error();
        if (!bodies_b) return bodies_b.error();
        found_.body = firstBodyDifference(*bodies_a, *bodies_b);
        return {};
    }
    Result<void> measureMotion() {
        const auto bodies_a = a_.bodies(), bodies_b = b_.bodies();
        if (!bodies_a) return bodies_a.error();
        if (!bodies_b) return bodies_b.error();
        found_.motion = motionDifference(*bodies_a, *bodies_b);
        return {};
    }
    Result<void> trace() {
        const uint32_t last = *found_.first_difference;
        for (uint32_t step = last; step >= a_.firstStep() && step + kBetweenStates > last; --step) {
            const auto state = a_.stateBefore(step);
            if (!state) return state.error();
            auto compared = compareFrom(step, *state, *state, true);
            if (!compared) return compared;
            if (found_.traced && found_.traced->comparison.finding() != nullptr) return {};
        }
        return traceApart(last);
    }
    // From the state that each world has of its own.
    Result<void> traceApart(uint32_t step) {
        const auto state_a = a_.stateBefore(step), state_b = b_.stateBefore(step);
        if (!state_a) return state_a.error();
        if (!state_b) return state_b.error();
        return compareFrom(step, *state_a, *state_b, false);
    }
    Result<void> compareFrom(uint32_t step, const State& state_a, const State& state_b, bool is_same) {
        auto compared = compareStep(a_.compared(), b_.compared(), state_a, state_b);
        const bool is_refused = !compared && compared.error().code == ErrorCode::BadInput && is_same;
        if (is_refused) return {}; // device B has lists of other sizes
        if (!compared) return compared.error();
        found_.traced = TracedStep{step, std::move(*compared), is_same};
        return {};
    }

    TracedWorld a_, b_;
    const ComparisonOptions& options_;
    WorldComparison found_;
};

} // namespace

Result<WorldComparison> compareWorlds(ComparedWorld a, ComparedWorld b, const ComparisonOptions& options) {
    return WorldComparer(a, b, options).run();
}

} // namespace brittle
