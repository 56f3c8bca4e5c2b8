#include "modules/brittle/dynamics/step_settings.h"
#include "modules/brittle/mesh/vector_math.h"

#include "shaders-spirv/shared/effects.h"
#include "shaders-spirv/shared/fracture.h"
#include "shaders-spirv/shared/solver.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <string>

namespace brittle {
namespace {

using engine::Error;
using engine::ErrorCode;
using engine::Result;

// The bits of what a kernel multiplies by (lib/air_drag.glsl).
uint32_t dragWord(const StepSettings& s) {
    return std::bit_cast<uint32_t>(static_cast<float>(0.5 * s.air_density * s.drag_coefficient * std::numbers::pi));
}

} // namespace

double contactHertz(const StepSettings& s) {
    const double most = STIFFEST * s.substeps / s.dt;
    return s.contact_hertz > 0 ? std::min(s.contact_hertz, most) : most;
}

double contactMargin(const StepSettings& s) {
    constexpr double kUsual = 0.02, kUsualStep = 1.0 / 60;
    return s.margin > 0 ? s.margin : kUsual * (s.dt / kUsualStep) * (s.dt / kUsualStep);
}

double pushOut(const StepSettings& s) {
    constexpr double kUsual = 3, kUsualFall = 9.81 / 60; // m/s, in a step
    return s.push_out > 0 ? s.push_out : kUsual * (s.dt * length(s.gravity) / kUsualFall);
}

double pushShare(const StepSettings& s) {
    constexpr double kShare = 0.004;
    return s.push_out > 0 ? 0 : kShare;
}

float leastVolumeOf(const StepSettings& s) {
    return static_cast<float>(s.smallest_piece * s.smallest_piece * s.smallest_piece);
}

Result<void> checkSettings(const StepSettings& s) {
    const auto refuse = [](const std::string& why) { return Error{ErrorCode::BadInput, "world: " + why}; };
    for (const double g : s.gravity)
        if (!(std::fabs(g) <= 1e4)) return refuse("gravity is no number or beyond 1e4 m/s2");
    if (!(s.dt >= 1e-6 && s.dt <= 1)) return refuse("a step takes " + std::to_string(s.dt) + " s; give it 1e-6 to 1");
    if (s.most_substeps < 1 || s.most_substeps > 2000)
        return refuse(std::to_string(s.most_substeps) + " substeps at the most; give 1 to 2000");
    if (s.substeps < 1 || s.substeps > 64) return refuse(std::to_string(s.substeps) + " substeps; give 1 to 64");
    if (s.iterations < 1 || s.iterations > 64) return refuse(std::to_string(s.iterations) + " iterations; give 1 to 64");
    if (!(s.contact_hertz >= 0 && s.contact_hertz <= 1e4) || !(s.contact_damping >= 0 && s.contact_damping <= 1e4))
        return refuse("contacts of that frequency or damping; give 0 to 1e4");
    if (!(s.push_out >= 0 && s.push_out <= 1e4) || !(s.bounce_speed >= 0))
        return refuse("a push-out or a speed of bouncing that is negative or no number");
    if (!(s.sleep_speed >= 0 && s.sleep_after >= 0))
        return refuse("sleep below a speed or after a time that is negative or no number");
    if (!(s.air_density >= 0 && s.air_density <= 1e4) || !(s.drag_coefficient >= 0 && s.drag_coefficient <= 100))
        return refuse("a density of the air or a drag coefficient that is out of range; give 0 to 1e4 kg/m3, 0 to 100");
    if (s.impact_fracture && !s.ccd)
        return refuse("bodies break only where fast ones are held back: ccd comes with impact_fracture");
    if (!(s.smallest_piece >= 0 && s.smallest_piece <= 100))
        return refuse("a smallest piece of " + std::to_string(s.smallest_piece) + " m; give 0 to 100");
    if (!(s.dust_lifetime >= 0 && s.dust_lifetime <= 1e6)) return refuse("dust that lasts that long; give 0 to 1e6 s");
    if (!(s.debris_below >= 0 && s.debris_below <= 1e3)) return refuse("debris below that size; give 0 to 1000 m");
    if (!(s.debris_after >= 0 && s.debris_after <= 1e6 && s.debris_fade >= 0 && s.debris_fade <= 1e6))
        return refuse("debris that rests or fades for that long; give 0 to 1e6 s");
    if (!(s.impact_speed > 0 && s.impact_speed <= 1e4))
        return refuse("impacts from that speed on; give more than 0, 1e4 m/s at most");
    if (!(s.blow_time >= 0 && s.blow_time <= 1e3)) return refuse("a blow of that many seconds; give 0 to 1000");
    if (!(s.margin >= 0 && s.margin <= 1)) return refuse("a margin of " + std::to_string(s.margin) + " m; give 0 to 1");
    return {};
}

EffectSet effectsOf(const StepSettings& s) {
    EffectSet set;
    const auto addIf = [&](bool asked_for, Effect effect) {
        if (asked_for) set.add(effect);
    };
    addIf(s.gravity != Double3{0, 0, 0}, Effect::Gravity);
    addIf(s.contacts, Effect::Contacts);
    addIf(s.contacts && s.friction, Effect::Friction);
    addIf(s.contacts && s.restitution, Effect::Restitution);
    addIf(s.contacts && s.ccd, Effect::Ccd);
    addIf(s.contacts && s.sleeping, Effect::Sleeping);
    addIf(s.drag, Effect::Drag);
    addIf(s.contacts && s.impact_fracture, Effect::ImpactFracture);
    addIf(s.events, Effect::Events);
    addIf(s.contacts && s.impact_fracture && s.refracture, Effect::Refracture);
    addIf(s.contacts && s.impact_fracture && s.dust, Effect::Dust);
    addIf(s.contacts && s.impact_fracture && s.debris_lifetime, Effect::DebrisLifetime);
    addIf(s.contacts && s.impact_fracture && s.debris_room, Effect::DebrisRoom);
    return set;
}

std::vector<engine::SpecConstant> kernelConstants(const StepSettings& settings, uint32_t group_size) {
    const EffectSet effects = effectsOf(settings);
    const auto on = [&](Effect effect) { return effects.has(effect) ? 1u : 0u; };
    return {{FLAT_SIZE_ID, group_size},
            {CONTACTS_ID, on(Effect::Contacts)},
            {FRICTION_ID, on(Effect::Friction)},
            {CCD_ID, on(Effect::Ccd)},
            {SIBLINGS_ID, on(Effect::ImpactFracture)},
            {DRAG_ID, effects.has(Effect::Drag) ? dragWord(settings) : 0}};
}

} // namespace brittle
