#include "tests/hard/hard_case.h"

#include "modules/brittle/scene/library/builtin_scenes.h"

#include <algorithm>
#include <utility>

namespace hard {

support::MeasuredScene& Trial::scene(const brittle::SceneDescription& description) {
    auto& run = *scenes_.emplace_back(std::make_unique<support::MeasuredScene>(description));
    if (failure_) return run;
    if (auto made = run.make(device_, make_mover_); !made) {
        const bool cannot_move = make_mover_ && made.error().code == engine::ErrorCode::Feature;
        cannot_move ? leaveOut(made.error().message) : fail(made.error().message);
    }
    return run;
}

support::MeasuredScene& Trial::scene(const std::string& name) {
    auto description = brittle::makeBuiltinScene(name);
    if (!description) fail(description.error().message);
    return scene(description ? *description : brittle::SceneDescription());
}

bool Trial::step(support::MeasuredScene& run, uint32_t steps) {
    if (failure_) return false;
    if (auto done = run.advance(steps); !done) fail(done.error().message);
    if (!failure_ && !run.isFinite()) fail("a body is no longer where numbers are");
    return !failure_;
}

void Trial::check(std::string what, double value, double allowed, std::string unit, std::string body) {
    if (!failure_) checks_.push_back({std::move(what), std::move(unit), value, allowed, false, std::move(body)});
}

void Trial::knownShortfall(std::string what, double value, double allowed, std::string unit) {
    if (!failure_) checks_.push_back({std::move(what), std::move(unit), value, allowed, true});
}

void Trial::fail(std::string why) {
    if (!failure_) failure_ = std::move(why);
}

void Trial::leaveOut(std::string why) {
    is_left_out_ = true;
    fail(std::move(why));
}

bool Trial::holds() const {
    return !failure_ &&
           std::ranges::all_of(checks_, [](const Check& check) { return check.is_known_shortfall || check.holds(); });
}

} // namespace hard
