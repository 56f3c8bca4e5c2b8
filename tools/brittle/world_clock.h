// A world that is asked where its bodies are at moments between its steps, and how long its steps take.
#pragma once

#include "tools/brittle/body_cast.h"
#include "tools/brittle/motion_output.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace cli {

class WorldClock {
public:
    // `surfaces`: of all bodies, where it is asked for poses (BodyCast).
    WorldClock(brittle::World& world, brittle::WorldSurfaces& surfaces, double dt, uint64_t last_step)
        : world_(world), cast_(world, surfaces), dt_(dt), last_step_(last_step) {}

    // Moments in order. On a step it is the step's own state, between two steps evenly on the way from one to the other, of
    // the bodies that there are at the first of the two; dust goes on from the first as it flies there.
    engine::Result<Moment> momentAt(double time);
    engine::Result<void> advanceTo(uint64_t step);
    // Of all steps, where the scene has the effect `events`.
    const brittle::Breaks& breaks() const { return breaks_; }
    const brittle::Impacts& impacts() const { return impacts_; }
    const std::vector<double>& stepTimes() const { return ms_; }                          // ms, wall clock
    const std::vector<std::pair<std::string, double>>& stages() const { return stages_; } // ms on the device, of all steps

private:
    struct Kept {
        brittle::Poses poses;
        std::vector<gpu::DustParticle> dust;
    };
    engine::Result<const Kept*> keptOf(uint64_t step);
    engine::Result<void> stepOnce();
    engine::Result<void> hearEvents();
    void addStage(const engine::Timing& timing);

    brittle::World& world_;
    BodyCast cast_;
    double dt_;
    uint64_t last_step_, made_ = 0;
    std::map<uint64_t, Kept> kept_; // by step: the last two that were asked for
    brittle::Breaks breaks_;
    brittle::Impacts impacts_;
    std::vector<double> ms_;
    std::vector<std::pair<std::string, double>> stages_;
};

} // namespace cli
