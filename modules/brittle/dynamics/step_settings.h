// How a world is stepped, and which effects that makes.
#pragma once

#include "engine/kernel.h"
#include "modules/brittle/effects/effect_set.h"
#include "modules/brittle/mesh/mesh.h"

#include <cstdint>
#include <vector>

namespace brittle {

struct StepSettings {
    Double3 gravity = {0, -9.81, 0};
    double dt = 1.0 / 60;          // s
    uint32_t substeps = 4;         // 1 to 64
    uint32_t most_substeps = 1500; // that an island takes whose loads need more (shaders-spirv/lib/pace.glsl), 1 to 2000
    uint32_t iterations = 1;       // over all contacts, with push and without, in each substep: 1 to 64
    bool contacts = true;          // without them bodies fly and fall through each other, and nothing is looked for or solved
    double contact_hertz = 0;      // of the spring that pushes overlap out; 0: as stiff as the substeps allow
    double contact_damping = 10;
    double push_out = 0; // m/s, the most that overlap is pushed out with; 0: as gravity and bodies have it (pushOut, pushShare)
    double margin = 0;   // m: points that are still so far apart are contacts already; 0: contactMargin()
    double bounce_speed = 0.25; // m/s: what comes in slower does not bounce
    bool hard_solver = false;   // heaps get all substeps that their loads need, as stacks do, and all get twice as many
    uint32_t fixed_axes = 0;    // of the narrow phase; 0: all axes of both hulls
    bool friction = true;       // these four act where contacts are
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
    bool impact_fracture = false; // bodies break where they are hit hard enough (breaking/breakable.h says which can)
    bool refracture = false;      // so do their fragments
    bool events = false;          // the host is told what has broken and what was hit (World::breaks, World::impacts)
    double impact_speed = 0.25;   // m/s: what meets more slowly is no impact to tell of
    uint64_t breaking_seed = 1;
    double blow_time = 0.05;       // s: for so long a blow does not break the fragments that it has made
    double smallest_piece = 0.002; // m: a cell of what breaks whose volume is less than that of a cube of this edge is no body;
                                   // 0: every cell is one
    bool dust = false;             // such cells fly on as particles (breaking/dust.h)
    double dust_lifetime = 4;      // s, after which particles settle
    bool debris_lifetime = false;  // small fragments that have come to rest fade and go (breaking/debris.h)
    bool debris_room = false;      // where room for fragments runs short, small old ones at rest go (breaking/debris.h)
    double debris_below = 0.05;    // m: whose volume is less than that of a cube of this edge
    double debris_after = 3;       // s of rest
    double debris_fade = 1;        // s
};

// Hz. The frequency of the spring that pushes overlap out: that of the settings, but at most an eighth of the substeps a
// second. Stiffer springs would not come to rest.
double contactHertz(const StepSettings& settings);

// m. How far apart points may be to count as contacts: that of the settings, or 2 cm at 60 steps a second. What moves by
// gravity in a step goes with the square of the step, and so does the margin.
double contactMargin(const StepSettings& settings);

// m/s, the most that overlap is pushed out with: that of the settings, or what gravity gives in about 18 steps, but no less
// than pushShare.
double pushOut(const StepSettings& settings);
// Overlap may be pushed out by this share of the shorter arm of a contact in a step. 0 if the settings have push_out.
double pushShare(const StepSettings& settings);

// m3, that a body has at the least.
float leastVolumeOf(const StepSettings& settings);

// BadInput for what is out of range.
engine::Result<void> checkSettings(const StepSettings& settings);

// What a world of these settings has: buffers, passes and the code of kernels follow from it.
EffectSet effectsOf(const StepSettings& settings);

// What all kernels of such a world are specialized with (shaders-spirv/shared/effects.h).
std::vector<engine::SpecConstant> kernelConstants(const StepSettings& settings, uint32_t group_size);

} // namespace brittle
