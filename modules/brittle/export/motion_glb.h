// Bodies in motion as a binary glTF file.
//
// A node for every body, with its name and its mesh (equal surfaces share one), below a node `world` whose translation is what
// the positions of all others count from (dynamics/pose.h, originOf). An animation `motion` moves the nodes by translation and
// rotation, linear between the times given; what is at one place at all of them has no part in it, and colliders never have.
// What appears later or goes earlier than the last time has a scale of 0 when it is not there, in steps, and no keys then.
// What fades gets smaller in the same steps. Before the animation the nodes stand where they do at the first time, or where
// they appear. Materials are `outer` and `inner` as of fragments, and `still` for what does not move. The node `camera` is the
// scene's.
#pragma once

#include "engine/result.h"
#include "modules/brittle/dynamics/body_surface.h"
#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/scene/scene_description.h"

#include <span>
#include <string>
#include <vector>

namespace brittle {

// While a body is there: one key for each time, from the first on.
struct BodyTrack {
    size_t first = 0;
    std::vector<std::array<float, 3>> places; // from the origin
    std::vector<std::array<float, 4>> turns;  // unit, each nearer to the last one than to its opposite
    std::vector<float> scales;
    size_t end() const { return first + places.size(); }
};

class MotionGlb {
public:
    // `surfaces` may grow until the motion is encoded.
    MotionGlb(const WorldSurfaces& surfaces, const CameraDescription& camera, const Double3& origin)
        : surfaces_(surfaces), camera_(camera), origin_(origin) {}
    // Where bodies are at a time (s) after the last one given; what has gone does not come back. Errors: Capacity, where the
    // file could not hold it; BadInput where floats cannot tell the time from the last one.
    engine::Result<void> add(double time, const Poses& poses);
    // The file's bytes: the same for the same motion. Errors: Capacity.
    engine::Result<std::string> encode() const;

private:
    void addKey(BodyTrack& track, const Pose& pose);

    const WorldSurfaces& surfaces_;
    CameraDescription camera_;
    Double3 origin_;
    std::vector<float> times_;
    std::vector<BodyTrack> tracks_; // by body; of those behind the last nothing is known yet
    size_t keys_ = 0;               // of all
};

} // namespace brittle
