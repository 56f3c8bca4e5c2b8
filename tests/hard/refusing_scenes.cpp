#include "tests/hard/refusing_scenes.h"

#include "modules/brittle/scene/check_scene.h"
#include "modules/brittle/scene/library/builtin_scenes.h"

#include <algorithm>
#include <cstring>

namespace hard {
namespace {

using support::MeasuredScene;

size_t differences(const std::vector<gpu::BodyState>& a, const std::vector<gpu::BodyState>& b) {
    size_t count = a.size() == b.size() ? 0 : 1;
    for (size_t k = 0; k < std::min(a.size(), b.size()); ++k)
        count += std::memcmp(&a[k], &b[k], sizeof(gpu::BodyState)) != 0 ? 1 : 0;
    return count;
}

std::vector<gpu::BodyState> stackAfterASecond(Trial& trial) {
    MeasuredScene& run = trial.scene("stack_3");
    std::vector<gpu::BodyState> states;
    if (!trial.step(run, 60)) return states;
    for (size_t b = 0; b < run.bodyCount(); ++b)
        states.push_back(run.state(b));
    return states;
}

// The first step for which there is no room leaves bodies as they were and says what lacks.
void lookAtFailure(Trial& trial, MeasuredScene& run, const std::vector<gpu::BodyState>& before, const engine::Error& error) {
    const auto after = run.world().bodies();
    if (!after) return trial.fail(after.error().message);
    const bool says = error.code == engine::ErrorCode::Capacity &&
                      error.message.find("room for 32; raise the budget of pairs") != std::string::npos;
    trial.check("errors that do not say what lacks", says ? 0 : 1, 0);
    trial.check("bodies that the failed step has changed", static_cast<double>(differences(before, *after)), 0);
}

} // namespace

void overflowLosesNothing(Trial& trial, const SceneCase& self) {
    MeasuredScene& run = trial.scene(self.name);
    for (uint32_t step = 0; !trial.failure() && step < run.scene().step.steps; ++step) {
        const auto before = run.world().bodies();
        if (!before) return trial.fail(before.error().message);
        if (const auto done = run.world().step(1); !done) return lookAtFailure(trial, run, *before, done.error());
    }
    trial.fail("a hundred hulls met in 32 pairs");
}

// Where a body is refused, the world is as if nobody had tried to add it.
void isRefused(Trial& trial, const SceneCase& self) {
    const std::vector<gpu::BodyState> expected = stackAfterASecond(trial);
    double cases = 0, taken = 0, unnamed = 0;
    for (const brittle::RefusedScene& refused : brittle::refusedScenes()) {
        if (refused.scene.name.find(self.name) == std::string::npos) continue;
        ++cases;
        const auto checked = brittle::checkScene(refused.scene);
        const bool is_refused = !checked && checked.error().code == engine::ErrorCode::BadInput;
        taken += is_refused ? 0 : 1;
        unnamed += is_refused && checked.error().message.find("'bad'") == std::string::npos ? 1 : 0;
    }
    trial.check("bad bodies, of 4 missing", std::max(0.0, 4 - cases), 0);
    trial.check("bad bodies taken", taken, 0);
    trial.check("refusals that do not name the body", unnamed, 0);
    trial.check("other bodies that move differently", static_cast<double>(differences(expected, stackAfterASecond(trial))), 0);
}

} // namespace hard
