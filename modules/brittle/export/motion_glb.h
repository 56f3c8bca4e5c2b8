// Bodies in motion as a binary glTF file.
//
// A node for every body, with its name and its mesh (equal surfaces share one), below a node `world` whose translation is what
// the positions of all others count from (dynamics/pose.h, originOf). An animation `motion` moves the nodes by translation and
// rotation, linear between the times given; what is at one place at all of them has no part in it, and colliders never have.
// Before the animation the nodes stand where they do at the first time. Materials are `outer` and `inner` as of fragments, and
// `still` for what does not move. The node `camera` is the scene's.
#pragma once

#include "engine/result.h"
#include "modules/brittle/dynamics/body_surface.h"
#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/scene/scene_description.h"

#include <span>
#include <string>
#include <vector>

namespace brittle {

class MotionGlb {
public:
    MotionGlb(const WorldSurfaces& surfaces, const CameraDescription& camera, const Double3& origin)
        : surfaces_(surfaces), camera_(camera), origin_(origin) {}
    // Where all bodies are at a time (s) after the last one given. Errors: Capacity, where the file could not hold it; BadInput
    // where floats cannot tell the time from the last one.
    engine::Result<void> add(double time, std::span<const Pose> poses);
    // The file's bytes: the same for the same motion. Errors: Capacity.
    engine::Result<std::string> encode() const;

private:
    const WorldSurfaces& surfaces_;
    CameraDescription camera_;
    Double3 origin_;
    std::vector<float> times_;
    std::vector<std::array<float, 3>> places_; // of all bodies at the first time, then at the next, from the origin
    std::vector<std::array<float, 4>> turns_;  // likewise; unit, each nearer to the last one of its body than to its opposite
};

} // namespace brittle
