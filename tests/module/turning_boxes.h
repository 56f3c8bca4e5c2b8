// Where and when two boxes meet that fly straight, each turning about one of its own axes, found by walking along their way in
// double precision: slow and obvious.
#pragma once

#include "modules/brittle/scene/scene_description.h"

#include <Eigen/Geometry>

#include <optional>

namespace turning_boxes {

struct TurningBox {
    Eigen::Vector3d size = {1, 1, 1}, place = {0, 0, 0}, velocity = {0, 0, 0};
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
    uint32_t axis = 0; // its own, that it turns about
    double spin = 0;   // rad/s

    brittle::BodyDescription described(const char* material) const;
    TurningBox after(double seconds) const;
};

struct Meeting {
    double time;  // s
    double speed; // m/s, along the normal
    double mass;  // kg, effective
    double energy() const { return 0.5 * mass * speed * speed; }
};

// None within a second. `density`: of both, kg/m3.
std::optional<Meeting> firstMeeting(const TurningBox& a, const TurningBox& b, double density);

} // namespace turning_boxes
