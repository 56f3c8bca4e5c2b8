// Reads back a GLB of bodies in motion: just enough of glTF 2.0 for that, and suspicious of everything.
#pragma once

#include "tests/reference/geometry.h"

#include <array>
#include <string>
#include <vector>

namespace reference {

using Quaternion = std::array<double, 4>; // x, y, z, w

struct MovingBody {
    std::string name;
    size_t mesh = 0;
    Triangles outer, inner, still; // by material, in the body's frame
    bool moves = false;            // has a part in the animation; else all of its keys are its node's
    std::vector<Point> places;     // of its frame, one for each time
    std::vector<Quaternion> turns;
    std::vector<bool> there; // likewise; false where it has a scale of 0

    size_t firstSeen() const; // of the times; as many as there are where it never is
    size_t timesSeen() const;
};

struct MotionFile {
    Point origin = {0, 0, 0};  // what places count from
    std::vector<double> times; // of all keys; one, 0, where nothing is animated
    std::vector<MovingBody> bodies;
    Point eye = {0, 0, 0}; // of the camera, from the origin
    Quaternion view = {0, 0, 0, 1};
    size_t meshes = 0;
    std::vector<std::string> faults; // in form: times, turns, names, materials, accessor bounds

    const MovingBody& body(const std::string& name) const; // throws where there is none
};

Point turnedBy(const Quaternion& q, const Point& p);
// The surface of a body at one of the times, counted from the origin.
Triangles placed(const Triangles& triangles, const MovingBody& body, size_t time);

// Throws std::runtime_error where the file cannot be read at all.
MotionFile readMotionFile(const std::string& path);

} // namespace reference
