#include "tools/accuracy/scene_truth.h"

#include "modules/brittle/mesh/vector_math.h"
#include "tests/reference/rigid_motion.h"
#include "tests/support/body_overlaps.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace accuracy {

using brittle::Double3;
using brittle::operator+, brittle::operator-, brittle::operator*;

namespace kinds {
const ErrorKind kPenetration = {"penetration", "overlap of bodies, 99 of 100 are less deep", "mm",
                                "the separating axis theorem in double precision, over the second half of the time"};
const ErrorKind kDrift = {"drift", "furthest way of what should stand", "mm", "closed form: it stays where it is"};
const ErrorKind kEnergy = {"energy", "mechanical energy that comes from nowhere", "share", "closed form: it never grows"};
const ErrorKind kMomentum = {"momentum", "angular momentum that is lost or gained", "share", "closed form: it stays"};
const ErrorKind kTurn = {"turn", "angle from where it should have turned to", "degrees",
                         "Runge and Kutta's fourth order in double precision"};
const ErrorKind kTrajectory = {"trajectory", "distance from where bodies should be, mean", "mm",
                               "the same world at a sixty-fourth of the default's dt"};
const ErrorKind kHeight = {"height", "distance from where it should be, at most", "mm",
                           "closed form: a parabola before the bounce and one after it"};
const ErrorKind kBeyond = {"beyond", "furthest way into or behind the wall", "mm", "closed form: none"};
} // namespace kinds

namespace {

constexpr double kMillimeters = 1e3;
constexpr double kReadBack = 1e-3;     // mm: places are read back as floats, to a millionth of a meter
constexpr double kFloats = 1e-6;       // of energies and momenta of states in floats
constexpr double kFloatAngle = 1e-4;   // degrees, likewise
constexpr double kMostOverlaps = 0.99; // of them are less deep

Double3 xyz(const gpu::vec4& v) { return {v.x, v.y, v.z}; }
double sizeOf(const Double3& v) { return std::sqrt(brittle::dot(v, v)); }
bool moves(const gpu::BodyState& body) { return body.offset.w > 0; }
Double3 placeOf(const gpu::BodyState& body) { return support::poseOf(body).place; }

std::vector<double> overlapsAt(const SceneStart& start, const Moment& moment) {
    std::vector<support::Pose> poses;
    for (const gpu::BodyState& body : moment.bodies)
        poses.push_back(support::poseOf(body));
    return support::overlapsOf(start.contents, poses);
}

// m, the mean over the bodies that move in both.
double meanDistance(const Moment& a, const Moment& b) {
    double sum = 0, count = 0;
    for (size_t k = 0; k < a.bodies.size(); ++k)
        if (moves(a.bodies[k]) && moves(b.bodies[k])) {
            sum += sizeOf(placeOf(a.bodies[k]) - placeOf(b.bodies[k]));
            ++count;
        }
    return count > 0 ? sum / count : 0;
}

// The pile begins high above where it ends: what its energy may be compared with is how much of that it has lost.
class PileTruth : public SceneTruth {
public:
    PileTruth(const SceneStart& start, const FineRun& fine) : start_(start), fine_(fine) {}
    void see(const Moment& moment) override {
        const double energy = mechanicalEnergy(start_.scene.gravity, moment.bodies, 0);
        if (seen_.empty()) first_ = lowest_ = energy;
        gained_ = std::max(gained_, energy - lowest_);
        lowest_ = std::min(lowest_, energy);
        for (const Moment& fine : fine_.moments)
            if (std::fabs(fine.seconds - moment.seconds) < 1e-6) distance_ = meanDistance(fine, moment);
        seen_.push_back(moment);
    }
    std::vector<MeasuredError> errors() const override {
        std::vector<double> depths;
        for (size_t k = seen_.size() / 2; k < seen_.size(); ++k) {
            const std::vector<double> more = overlapsAt(start_, seen_[k]);
            depths.insert(depths.end(), more.begin(), more.end());
        }
        std::ranges::sort(depths);
        std::vector<MeasuredError> all = {
            {kinds::kPenetration.name, kMillimeters * support::percentile(depths, kMostOverlaps), kReadBack},
            {kinds::kEnergy.name, gained_ / std::max(first_ - lowest_, 1e-300), kFloats}};
        if (distance_) all.push_back({kinds::kTrajectory.name, kMillimeters * *distance_, fine_.resolution});
        return all;
    }

private:
    const SceneStart& start_;
    const FineRun& fine_;
    std::vector<Moment> seen_;
    double first_ = 0, lowest_ = 0, gained_ = 0;
    std::optional<double> distance_;
};

class StackTruth : public SceneTruth {
public:
    explicit StackTruth(const SceneStart& start) : start_(start) {}
    void see(const Moment& moment) override {
        if (first_.empty()) first_ = moment.bodies;
        for (size_t b = 0; b < first_.size(); ++b)
            furthest_ = std::max(furthest_, sizeOf(placeOf(moment.bodies[b]) - placeOf(first_[b])));
        last_ = moment;
    }
    std::vector<MeasuredError> errors() const override {
        const double deepest = support::percentile(overlapsAt(start_, last_), kMostOverlaps);
        return {{kinds::kDrift.name, kMillimeters * furthest_, kReadBack},
                {kinds::kPenetration.name, kMillimeters * deepest, kReadBack}};
    }

private:
    const SceneStart& start_;
    std::vector<gpu::BodyState> first_;
    Moment last_;
    double furthest_ = 0;
};

class SpinTruth : public SceneTruth {
public:
    explicit SpinTruth(const SceneStart& start) : start_(start) {}
    void see(const Moment& moment) override {
        const gpu::BodyState& body = moment.bodies.front();
        if (moment.seconds == 0) begin(body);
        const double energy = 0.5 * brittle::dot(xyz(body.momentum), xyz(body.spin));
        energy_off_ = std::max(energy_off_, std::fabs(energy / energy_ - 1));
        momentum_off_ = std::max(momentum_off_, sizeOf(xyz(body.momentum) - free_.momentum) / sizeOf(free_.momentum));
        const support::Pose pose = support::poseOf(body);
        const double angle = reference::angleBetween(reference::turnAfter(free_, moment.seconds), pose.turn);
        angle_ = std::max(angle_, angle * 180 / std::numbers::pi);
    }
    std::vector<MeasuredError> errors() const override {
        return {{kinds::kTurn.name, angle_, kFloatAngle},
                {kinds::kEnergy.name, energy_off_, kFloats},
                {kinds::kMomentum.name, momentum_off_, kFloats}};
    }

private:
    void begin(const gpu::BodyState& body) {
        const gpu::BodyShape& shape = start_.contents.shapes.front();
        free_.moments = {1.0 / shape.inverse_inertia[0].x, 1.0 / shape.inverse_inertia[1].y, 1.0 / shape.inverse_inertia[2].z};
        free_.turn = support::poseOf(body).turn;
        free_.momentum = xyz(body.momentum);
        energy_ = 0.5 * brittle::dot(free_.momentum, reference::spinOf(free_));
    }
    const SceneStart& start_;
    reference::FreeTurning free_;
    double energy_ = 0, energy_off_ = 0, momentum_off_ = 0, angle_ = 0;
};

// A cube falls flat onto y = 0, bounces once, and is on its way up or down again.
class BounceTruth : public SceneTruth {
public:
    explicit BounceTruth(const SceneStart& start)
        : gravity_(-start.scene.gravity[1]), restitution_(start.scene.bodies.front().surface.restitution),
          half_(start.scene.bodies.front().shape.size[1] / 2), height_(start.scene.bodies.front().place[1] - half_) {}
    void see(const Moment& moment) override {
        const double down = std::sqrt(2 * height_ / gravity_), since = moment.seconds - down;
        const double up = restitution_ * gravity_ * down;
        if (since > 2 * up / gravity_) return; // the second bounce has begun
        const double fallen = height_ - 0.5 * gravity_ * moment.seconds * moment.seconds;
        const double height = since < 0 ? fallen : up * since - 0.5 * gravity_ * since * since;
        furthest_ = std::max(furthest_, std::fabs(placeOf(moment.bodies.front())[1] - half_ - height));
    }
    std::vector<MeasuredError> errors() const override { return {{kinds::kHeight.name, kMillimeters * furthest_, kReadBack}}; }

private:
    double gravity_, restitution_, half_, height_, furthest_ = 0;
};

// A body flies along x at a wall.
class ShotTruth : public SceneTruth {
public:
    explicit ShotTruth(const SceneStart& start)
        : start_(start), face_(start.scene.colliders.front().place[0] - start.scene.colliders.front().shape.size[0] / 2) {}
    void see(const Moment& moment) override {
        const support::Pose pose = support::poseOf(moment.bodies.front());
        for (const reference::Point& corner : support::pieceInWorld(start_.contents, 0, pose).vertices)
            furthest_ = std::max(furthest_, corner[0] - face_);
    }
    std::vector<MeasuredError> errors() const override { return {{kinds::kBeyond.name, kMillimeters * furthest_, kReadBack}}; }

private:
    const SceneStart& start_;
    double face_, furthest_ = 0;
};

class WindowTruth : public SceneTruth {
public:
    explicit WindowTruth(const FineRun& fine) : fine_(fine) {}
    // Of the ball, which is what there is before and after: the scene's second body.
    void see(const Moment& moment) override {
        for (const Moment& fine : fine_.moments)
            if (std::fabs(fine.seconds - moment.seconds) < 1e-6)
                furthest_ = std::max(furthest_, sizeOf(placeOf(fine.bodies[1]) - placeOf(moment.bodies[1])));
    }
    std::vector<MeasuredError> errors() const override {
        return {{kinds::kTrajectory.name, kMillimeters * furthest_, fine_.resolution}};
    }

private:
    const FineRun& fine_;
    double furthest_ = 0;
};

} // namespace

double mechanicalEnergy(const Double3& gravity, std::span<const gpu::BodyState> bodies, double lag) {
    double sum = 0;
    for (const gpu::BodyState& body : bodies) {
        if (!moves(body)) continue;
        const double mass = 1 / double{body.offset.w}, speed = sizeOf(xyz(body.velocity) + lag * gravity);
        sum += 0.5 * mass * speed * speed + 0.5 * brittle::dot(xyz(body.momentum), xyz(body.spin)) -
               mass * brittle::dot(gravity, placeOf(body));
    }
    return sum;
}

std::unique_ptr<SceneTruth> pileTruth(const SceneStart& start, const FineRun& fine) {
    return std::make_unique<PileTruth>(start, fine);
}
std::unique_ptr<SceneTruth> stackTruth(const SceneStart& start, const FineRun&) { return std::make_unique<StackTruth>(start); }
std::unique_ptr<SceneTruth> spinTruth(const SceneStart& start, const FineRun&) { return std::make_unique<SpinTruth>(start); }
std::unique_ptr<SceneTruth> bounceTruth(const SceneStart& start, const FineRun&) {
    return std::make_unique<BounceTruth>(start);
}
std::unique_ptr<SceneTruth> shotTruth(const SceneStart& start, const FineRun&) { return std::make_unique<ShotTruth>(start); }
std::unique_ptr<SceneTruth> windowTruth(const SceneStart&, const FineRun& fine) { return std::make_unique<WindowTruth>(fine); }

} // namespace accuracy
