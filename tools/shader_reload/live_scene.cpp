#include "tools/shader_reload/live_scene.h"

#include "engine/reload/kernel_times.h"
#include "engine/reload/shader_reloader.h"
#include "tools/brittle/progress.h"
#include "tools/brittle/scene_source.h"
#include "tools/brittle/simulation.h"
#include "tools/shader_reload/scene_window.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <thread>
#include <utility>

namespace shader_reload {
namespace {

using engine::ReloadEvent;
using engine::Result;
using Clock = std::chrono::steady_clock;

constexpr size_t kTimedSteps = 60;
// How long the scene rests after a step where those who compile an edit share its cores, as a multiple of the step, and at
// most.
constexpr int kYield = 4;
constexpr std::chrono::milliseconds kLongestRest{100};
// Until a scene in which a step failed is tried again, if nothing is saved before.
constexpr std::chrono::milliseconds kBeforeNextTry{500};

volatile std::sig_atomic_t interrupted = 0;

class LiveScene {
public:
    LiveScene(const Options& options, cli::StagedScene& staged, brittle::World& world, engine::ShaderReloader& reloader,
              SceneWindow* window, bool is_cpu)
        : options_(options), staged_(staged), world_(world), reloader_(reloader), window_(window), is_cpu_(is_cpu) {}

    Result<void> run() {
        auto beginning = world_.save();
        if (!beginning) return beginning.error();
        beginning_ = std::move(*beginning);
        if (auto taken = awaitSources(); !taken) return taken;
        const auto pace = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(staged_.scene.step.dt));
        for (Clock::time_point next = Clock::now(); goesOn(); next = std::max(next + pace, Clock::now() - pace)) {
            const Clock::time_point begun = Clock::now();
            if (begun >= next_try_)
                if (auto stepped = stepAndShow(); !stepped)
                    if (auto begun_anew = beginAnew(stepped.error()); !begun_anew) return begun_anew;
            if (is_cpu_ && reloader_.isAwaited()) next = std::max(next, Clock::now() + restAfter(Clock::now() - begun));
            do {
                if (auto followed = follow(); !followed) return followed;
            } while (reloader_.waitUntil(next));
        }
        return tellEnd();
    }

private:
    bool goesOn() const {
        if (interrupted != 0 || (window_ != nullptr && window_->isClosed())) return false;
        return !options_.steps || steps_ < *options_.steps;
    }

    static Clock::duration restAfter(Clock::duration step) { return std::min<Clock::duration>(kYield * step, kLongestRest); }

    // Steps that are counted are all made by what the folder held when the program began.
    Result<void> awaitSources() {
        while (options_.steps && interrupted == 0 && reloader_.isAwaited()) {
            reloader_.waitUntil(Clock::now() + kBeforeNextTry);
            if (auto followed = follow(); !followed) return followed;
        }
        return {};
    }

    Result<void> follow() {
        const std::vector<ReloadEvent> events = reloader_.swap();
        if (auto taken_over = takeOver(events); !taken_over) return taken_over;
        for (const ReloadEvent& event : events)
            tell(event);
        return {};
    }

    void tell(const ReloadEvent& event) {
        if (!event.diagnostics.empty()) std::fprintf(stderr, "%s\n", textOf(event.diagnostics).c_str());
        std::printf("%s\n", textOf(event).c_str());
        std::fflush(stdout);
        if (event.kind != ReloadEvent::Kind::Reloaded) return;
        times_.reloaded(event.kernels);
        std::erase_if(edited_, [&](const std::string& name) { return std::ranges::count(event.kernels, name) != 0; });
        edited_.insert(edited_.begin(), event.kernels.begin(), event.kernels.end());
    }

    // What a version that made steps fail has left in the scene is nothing that the next one has to answer for.
    Result<void> takeOver(const std::vector<ReloadEvent>& events) {
        if (!engine::somethingRuns(events)) return {};
        if (auto recorded = world_.kernelsChanged(); !recorded) return recorded;
        next_try_ = {};
        if (!std::exchange(has_failed_, false)) return {};
        failure_.reset();
        return world_.restore(beginning_);
    }

    Result<void> stepAndShow() {
        if (auto stepped = step(); !stepped) return stepped;
        failure_.reset();
        return window_ != nullptr ? window_->show() : Result<void>();
    }

    // Kernels may be sound and spoil what they work on until a step fails. Whoever edits them wants to know, and to go on; a
    // failure of which no edit can be the reason is an end.
    Result<void> beginAnew(const engine::Error& why) {
        if (edited_.empty()) return why;
        if (!has_failed_)
            std::printf("step %u failed, after reloads of %s (the latest first): %s; the scene begins anew\n", steps_ + 1,
                        engine::listOf(edited_).c_str(), why.message.c_str());
        std::fflush(stdout);
        failure_ = why;
        has_failed_ = true;
        next_try_ = Clock::now() + kBeforeNextTry;
        ++steps_; // one that was asked for
        return world_.restore(beginning_);
    }

    Result<void> step() {
        if (!options_.steps && steps_ > 0 && steps_ % std::max(staged_.scene.step.steps, 1u) == 0)
            if (auto restored = world_.restore(beginning_); !restored) return restored;
        if (auto stepped = world_.step(); !stepped) return stepped;
        ++steps_;
        const auto timings = world_.timings();
        if (!timings) return timings.error();
        times_.add(*timings);
        for (const engine::KernelTimeChange& change : times_.takeChanges())
            std::printf("  %s: %.1f us a step before, %.1f us after (medians of %zu steps)\n", change.name.c_str(),
                        1000 * change.before_ms, 1000 * change.after_ms, kTimedSteps);
        std::fflush(stdout);
        return {};
    }

    // Steps that fail to the end are the kernels' fault, but for somebody who has seen enough of them.
    Result<void> tellEnd() {
        if (failure_ && interrupted == 0)
            return engine::Error{engine::ErrorCode::BadInput,
                                 "the scene cannot be stepped by these kernels: " + failure_->message};
        if (failure_) {
            std::printf("%u steps, the last of them failed\n", steps_);
            return {};
        }
        const auto hash = world_.hash();
        if (!hash) return hash.error();
        std::printf("%u steps, state %s\n", steps_, cli::hexOf(*hash).c_str());
        return {};
    }

    const Options& options_;
    cli::StagedScene& staged_;
    brittle::World& world_;
    engine::ShaderReloader& reloader_;
    SceneWindow* window_;
    bool is_cpu_;
    engine::KernelTimes times_{kTimedSteps};
    std::vector<std::byte> beginning_;
    uint32_t steps_ = 0;
    std::vector<std::string> edited_;      // kernels that have been reloaded, the latest first
    std::optional<engine::Error> failure_; // of the last step
    bool has_failed_ = false;              // a step, since something was reloaded last
    Clock::time_point next_try_;
};

// The second time at once: a driver that compiles cannot be interrupted.
void stopWhenInterrupted() {
    for (const int signal : {SIGINT, SIGTERM})
        std::signal(signal, [](int received) {
            interrupted = 1;
            std::signal(received, SIG_DFL);
        });
}

} // namespace

Result<void> runLive(const Options& options) {
    stopWhenInterrupted();
    auto scene = cli::readSceneOrBuiltin(options.scene);
    if (!scene) return scene.error();
    const auto device = engine::Device::create({.select = options.device});
    if (!device) return device.error();
    auto staged = cli::stageScene(**device, std::move(*scene), {options.scene, 0, options.window});
    if (!staged) return staged.error();
    const auto world = cli::worldOf(**device, *staged, 0);
    if (!world) return world.error();
    if (auto timed = (*world)->timeKernels(true); !timed) return timed;
    auto window =
        options.window ? SceneWindow::open(**device, *staged, **world) : Result<std::unique_ptr<SceneWindow>>(nullptr);
    if (!window) return window.error();
    const auto reloader =
        engine::ShaderReloader::start(**device, {.folder = options.folder, .include_folders = options.include_folders});
    if (!reloader) return reloader.error();
    (*reloader)->attach((*world)->kernels());
    cli::clearProgress();
    std::printf("%s on %s by %u kernels; watching %s%s\n", staged->scene.name.c_str(), (*device)->name().c_str(),
                (*world)->kernels().kernelCount(), options.folder.c_str(), options.steps ? "" : "; Ctrl+C ends");
    std::fflush(stdout);
    return LiveScene(options, *staged, **world, **reloader, window->get(), (*device)->isCpu()).run();
}

} // namespace shader_reload
