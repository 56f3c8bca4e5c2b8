// Cases that break fracture and rigid bodies, each with what it has to fulfill, measured in double precision. Tests assert them
// one by one; `brittle hard` runs them all and shows them in a table.
#pragma once

#include "engine/device.h"
#include "tests/support/measured_scene.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hard {

// Fulfilled where the value is at most what is allowed. What counts what is missing allows 0.
struct Check {
    std::string what, unit; // of shares and counts the unit is empty
    double value = 0, allowed = 0;
    bool is_known_shortfall = false; // it is not fulfilled, and nobody claims that it is
    std::string body = {};           // the one that was measured; empty: all of them
    bool holds() const { return value <= allowed; }
};

// What a case measures with. After a failure nothing is measured any more.
class Trial {
public:
    // `make_mover` makes what moves the scenes; without one that is Brittle.
    explicit Trial(engine::Device& device, support::MakeMover make_mover = {})
        : device_(device), make_mover_(std::move(make_mover)) {}

    engine::Device& device() { return device_; }
    support::MeasuredScene& scene(const std::string& name); // a built-in one, made anew; it lives as long as the trial
    support::MeasuredScene& scene(const brittle::SceneDescription& description);
    // Whether that could be done.
    bool step(support::MeasuredScene& run, uint32_t steps);
    bool finish(support::MeasuredScene& run) { return step(run, run.stepsLeft()); }

    void check(std::string what, double value, double allowed, std::string unit = "", std::string body = "");
    void knownShortfall(std::string what, double value, double allowed, std::string unit = "");
    void fail(std::string why);

    void leaveOut(std::string why);                 // what moves the scenes cannot be judged by this case
    bool isLeftOut() const { return is_left_out_; } // then the failure says why
    const std::vector<Check>& checks() const { return checks_; }
    const std::optional<std::string>& failure() const { return failure_; }
    bool holds() const; // nothing failed, and all that is not a known shortfall is fulfilled

private:
    engine::Device& device_;
    support::MakeMover make_mover_;
    bool is_left_out_ = false;
    std::vector<std::unique_ptr<support::MeasuredScene>> scenes_;
    std::vector<Check> checks_;
    std::optional<std::string> failure_;
};

struct SceneCase {
    const char* name; // of the scene, or the number that scenes have in common
    void (*measure)(Trial& trial, const SceneCase& self);
    double parameter = 0; // what it means is the measure's own
    bool is_long = false; // minutes on two cores
};

// Its checks look at how bodies move and at nothing that only a Brittle world tells, so any engine can be judged by them.
bool judgesMotionAlone(const SceneCase& self);

// In the order of their numbers.
std::span<const SceneCase> sceneCases();

} // namespace hard
