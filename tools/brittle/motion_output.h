// What a simulation is written to: a GLB with an animation, a picture or one for every frame, a film.
#pragma once

#include "engine/device.h"
#include "modules/brittle/dynamics/body_surface.h"
#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/scene/scene_description.h"

#include <memory>
#include <string>
#include <vector>

namespace cli {

constexpr const char* kMotionHelp = "the file to write: .glb with an animation, .mp4, or .png of the last moment; "
                                    "NAME_%04d.png is a picture for every frame";

constexpr double kMostSeconds = 1e6, kLeastFps = 0.001, kMostFps = 1000;

// What is to be seen; outlives the output.
struct Spectacle {
    engine::Device& device;
    const brittle::SceneDescription& scene;
    const brittle::WorldSurfaces& surfaces; // more of them as fragments appear
    brittle::Double3 origin;                // what floats are counted from
};

// A particle of dust.
struct Speck {
    brittle::Double3 place = {0, 0, 0};
    double radius = 0;   // m
    uint32_t origin = 0; // the body that it comes of, of the surfaces
};

// What is where.
struct Moment {
    brittle::Poses poses;
    std::vector<Speck> specks;
};

class MotionOutput {
public:
    // By the ending of its name. Fails before any work was done, where it can: an ending that is not known, a place that cannot
    // be written, no ffmpeg.
    static engine::Result<std::unique_ptr<MotionOutput>> create(const std::string& path, double fps);
    virtual ~MotionOutput() = default; // removes what was not committed

    // When it wants to know where bodies are. Errors: BadInput, for more than a million frames.
    virtual engine::Result<std::vector<double>> times(double seconds) const = 0;
    // In this order: once, for each of these times, once, once.
    virtual engine::Result<void> begin(const Spectacle& spectacle) = 0;
    virtual engine::Result<void> add(double time, const Moment& moment) = 0;
    virtual engine::Result<void> finish() = 0;
    virtual engine::Result<void> commit() = 0; // only now it is there
};

// Of a file's name, in small letters, with its dot; empty where it has none.
std::string endingOf(const std::string& path);

} // namespace cli
