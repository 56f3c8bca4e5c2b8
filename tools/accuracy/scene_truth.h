// Scenes of the sweep, and how far a world is from what should happen in them: closed forms, a double-precision integration of
// free turning, the separating axis theorem in double precision, and the same world at a sixty-fourth of the step.
#pragma once

#include "modules/brittle/dynamics/world.h"
#include "modules/brittle/scene/scene_description.h"
#include "tools/accuracy/results.h"

#include <memory>
#include <span>
#include <vector>

namespace accuracy {

// A moment of a world, read back.
struct Moment {
    double seconds = 0;
    std::vector<gpu::BodyState> bodies;
};

// J: of motion and of the height above the origin, of all bodies that move. `lag`: by which speeds are behind places, s.
double mechanicalEnergy(const brittle::Double3& gravity, std::span<const gpu::BodyState> bodies, double lag);

struct SceneStart {
    brittle::SceneDescription scene;
    brittle::WorldContents contents;
};

// One run of a scene; told of its moments in order, the beginning first.
class SceneTruth {
public:
    virtual ~SceneTruth() = default;
    virtual void see(const Moment& moment) = 0;
    virtual std::vector<MeasuredError> errors() const = 0;
};

// Where a much finer run of the same scene was at some of its moments.
struct FineRun {
    std::vector<Moment> moments;
    double resolution = 0; // mm: how far a run with steps twice as long is from it
};

using MakeTruth = std::unique_ptr<SceneTruth> (*)(const SceneStart& start, const FineRun& fine);
std::unique_ptr<SceneTruth> pileTruth(const SceneStart& start, const FineRun& fine);
std::unique_ptr<SceneTruth> stackTruth(const SceneStart& start, const FineRun& fine);
std::unique_ptr<SceneTruth> spinTruth(const SceneStart& start, const FineRun& fine);
std::unique_ptr<SceneTruth> bounceTruth(const SceneStart& start, const FineRun& fine);
std::unique_ptr<SceneTruth> shotTruth(const SceneStart& start, const FineRun& fine);
std::unique_ptr<SceneTruth> windowTruth(const SceneStart& start, const FineRun& fine);

namespace kinds {
extern const ErrorKind kPenetration, kDrift, kEnergy, kMomentum, kTurn, kTrajectory, kHeight, kBeyond;
}

} // namespace accuracy
