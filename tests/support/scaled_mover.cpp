#include "tests/support/scaled_mover.h"

#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/mesh/vector_math.h"
#include "tests/support/scaled_scene.h"
#include "tests/support/world_mover.h"

#include <cmath>
#include <utility>

namespace support {
namespace {

using brittle::Turn;
using brittle::operator*;
using engine::Error, engine::ErrorCode, engine::Result;

using MoverResult = Result<std::unique_ptr<Mover>>;

Turn conjugate(const Turn& q) { return {-q[0], -q[1], -q[2], q[3]}; }

Turn product(const Turn& p, const Turn& q) {
    return {p[3] * q[0] + p[0] * q[3] + p[1] * q[2] - p[2] * q[1], p[3] * q[1] - p[0] * q[2] + p[1] * q[3] + p[2] * q[0],
            p[3] * q[2] + p[0] * q[1] - p[1] * q[0] + p[2] * q[3], p[3] * q[3] - p[0] * q[0] - p[1] * q[1] - p[2] * q[2]};
}

// Keeps w.
void multiply(gpu::vec4& v, double factor) {
    const auto times = [factor](float x) { return static_cast<float>(factor * x); };
    v = {times(v.x), times(v.y), times(v.z), v.w};
}

// Not a Feature error: a case that needs more than the device has fails, and is not left out.
MoverResult makeWorld(engine::Device& device, const brittle::SceneDescription& scene, const brittle::WorldContents& contents) {
    auto mover = WorldMover::make(device, scene, contents);
    if (mover) return MoverResult(std::move(*mover));
    const bool lacks_feature = mover.error().code == ErrorCode::Feature;
    return Error{lacks_feature ? ErrorCode::Device : mover.error().code, mover.error().message};
}

class ScaledMover : public Mover {
public:
    ScaledMover(const brittle::WorldContents& contents, double scale) : first_(contents.bodies), scale_(scale) {}

    Result<void> make(engine::Device& device, const brittle::SceneDescription& scene, const MakeMover& make_inner) {
        scaled_ = scaled(scene, scale_);
        const auto fracture = brittle::fractureFor(scaled_, device);
        if (!fracture) return fracture.error();
        auto contents = brittle::contentsOf(scaled_, ".", fracture->get());
        if (!contents) return contents.error();
        contents_ = std::move(*contents);
        if (contents_.bodies.size() != first_.size())
            return Error{ErrorCode::Internal, "the scaled scene has " + std::to_string(contents_.bodies.size()) +
                                                  " bodies, expected " + std::to_string(first_.size())};
        auto inner = make_inner ? make_inner(scaled_, contents_) : makeWorld(device, scaled_, contents_);
        if (!inner) return inner.error();
        inner_ = std::move(*inner);
        return {};
    }

    Result<void> step(uint32_t steps) override { return inner_->step(steps); }

    Result<std::vector<gpu::BodyState>> bodies() override {
        auto states = inner_->bodies();
        if (!states) return states.error();
        for (size_t b = 0; b < states->size(); ++b)
            (*states)[b] = first_[b].offset.w == 0 ? first_[b] : scaledBack((*states)[b], b);
        return std::move(*states);
    }

    double substep() const override { return inner_->substep() / std::sqrt(scale_); }

private:
    // The principal axes of a cube are any three, so those of the scaled body may be others: the turn since the beginning
    // counts.
    gpu::BodyState scaledBack(gpu::BodyState state, size_t b) const {
        const double slower = std::sqrt(scale_);
        const brittle::Pose pose = brittle::poseOf(state);
        const Turn since = product(pose.turn, conjugate(brittle::poseOf(contents_.bodies[b]).turn));
        const Turn turn = product(since, brittle::poseOf(first_[b]).turn);
        state.turn = {static_cast<float>(turn[0]), static_cast<float>(turn[1]), static_cast<float>(turn[2]),
                      static_cast<float>(turn[3])};
        state.offset.w = first_[b].offset.w;
        moveTo(state, (1 / scale_) * pose.place);
        multiply(state.velocity, 1 / slower);
        multiply(state.spin, slower);
        multiply(state.momentum, 1 / (std::pow(scale_, 4) * slower));
        return state;
    }

    brittle::SceneDescription scaled_;
    brittle::WorldContents contents_; // of the scaled scene
    std::vector<gpu::BodyState> first_;
    double scale_;
    std::unique_ptr<Mover> inner_;
};

} // namespace

MakeMover scaledMover(engine::Device& device, double scale, MakeMover make_inner) {
    return [&device, scale, make_inner = std::move(make_inner)](const brittle::SceneDescription& scene,
                                                                const brittle::WorldContents& contents) -> MoverResult {
        auto mover = std::make_unique<ScaledMover>(contents, scale);
        if (auto made = mover->make(device, scene, make_inner); !made) return made.error();
        return MoverResult(std::move(mover));
    };
}

} // namespace support
