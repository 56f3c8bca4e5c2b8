// A world of rigid bodies that lives on the device: it is stepped there, and the host reads what it asks for and nothing else.
//
// A step (docs: modules/brittle/README.md) finds pairs of pieces whose boxes meet, the points where they touch, and solves them
// by soft sequential impulses in substeps, contact by contact in the order of colors (shaders-spirv/shared/solver.h).
#pragma once

#include "engine/commands.h"
#include "engine/device.h"
#include "modules/brittle/dynamics/world_contents.h"
#include "modules/brittle/effects/effect_set.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace brittle {

struct StepSettings {
    Double3 gravity = {0, -9.81, 0};
    double dt = 1.0 / 60;      // s
    uint32_t substeps = 4;     // 1 to 64
    uint32_t iterations = 1;   // over all contacts, with push and without, in each substep: 1 to 64
    bool contacts = true;      // without them bodies fly and fall through each other, and nothing is looked for or solved
    double contact_hertz = 30; // of the spring that pushes overlap out, no more than an eighth of the substeps a second
    double contact_damping = 10;
    double push_out = 3;         // m/s, the most that overlap is pushed out with
    double margin = 0.02;        // m: points that are still so far apart are contacts already
    double bounce_threshold = 1; // m/s: what comes in slower does not bounce
    uint32_t fixed_axes = 0;     // of the narrow phase; 0: all axes of both hulls
    bool friction = true;        // these four act where contacts are
    bool restitution = true;
    bool ccd = true;            // bodies that are fast for their size are held back where they would go too deep
    bool sleeping = false;      // islands that have come to rest are not solved
    double sleep_speed = 0.05;  // m/s: what moves and turns less in a step, rests; for a body of less than half a meter, a
                                // tenth of its radius a second
    double sleep_after = 0.5;   // s of rest
    bool recycling = true;      // points are kept while bodies hardly move against each other
    bool drag = false;          // air slows bodies as it would the balls around them (lib/air_drag.glsl)
    double air_density = 1.225; // kg/m3
    double drag_coefficient = 0.47;
};

// What a world of these settings has: buffers, passes and the code of kernels follow from it.
EffectSet effectsOf(const StepSettings& settings);

// How much there is room for; what is 0 is chosen by the contents, and grows when it is too small.
struct WorldBudget {
    uint32_t pairs = 0;
    uint32_t contacts = 0; // pairs that touch; 0: as many as there are pairs
    uint32_t group_size =
        0; // lanes of a workgroup where a lane is an element (Fracture::create); states are the same, bit for bit
};

struct WorldCounts {
    uint32_t bodies = 0, pieces = 0, pairs = 0, contacts = 0;
    uint32_t fresh = 0;     // pairs whose points were found anew
    uint32_t awake = 0;     // bodies that move and do not sleep
    uint32_t groups = 0;    // workgroups that bodies, pairs, contacts and colors were dispatched over; none while all sleep
    uint32_t colors = 0;    // in use
    uint32_t colorless = 0; // contacts for which there was no color left; they are solved one by one
};

class World {
public:
    // Errors: BadInput for settings out of range, Capacity for what the device cannot bind, Device.
    static engine::Result<std::unique_ptr<World>> create(engine::Device& device, const WorldContents& contents,
                                                         const StepSettings& settings = {}, const WorldBudget& budget = {});
    virtual ~World() = default;

    // Steps and waits. Errors: Capacity, with the pool and what it lacked, where the budget says how large it is or the device
    // can bind no more: the step that did not fit has not been made. BadInput, told once, for
    // a body, by its index as added, whose motion outgrew floats: it stays where it was, at rest.
    virtual engine::Result<void> step(uint32_t steps = 1) = 0;

    virtual engine::Result<std::vector<gpu::BodyState>> bodies() = 0;
    virtual engine::Result<WorldCounts> counts() = 0; // of the last step
    // Pieces whose boxes met in the last step, the lower one first, in order. None while all sleep.
    virtual engine::Result<std::vector<std::array<uint32_t, 2>>> pairs() = 0;
    // Of the last step, by stage, and how many dispatches it has.
    virtual engine::Result<std::vector<engine::Timing>> timings() = 0;
    virtual uint32_t dispatches() const = 0;

    // All that the next step depends on, as bytes; to be restored into a world of the same contents, settings and budget.
    virtual engine::Result<std::vector<std::byte>> save() = 0;
    virtual engine::Result<void> restore(std::span<const std::byte> state) = 0;
    // Of the bytes of all bodies, in the order of their ids.
    virtual engine::Result<uint64_t> hash() = 0;
};

} // namespace brittle
