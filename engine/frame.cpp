#include "engine/frame.h"

namespace engine {

Result<FrameReport> FrameLoop::step() {
    if (auto begun = commands_.begin(); !begun) return begun.error();
    FrameContext frame{device_, commands_, index_, dt_, time()};
    if (auto recorded = modules_.frame(frame); !recorded) return recorded.error();
    if (auto done = commands_.submitAndWait(); !done) return done.error();
    auto timings = commands_.timings();
    if (!timings) return timings.error();
    ++index_;
    return FrameReport{frame.index, time(), std::move(*timings)};
}

} // namespace engine
