#include "modules/brittle/dynamics/scene_settings.h"

#include <algorithm>

namespace brittle {

using engine::Result;

namespace {

// Contacts as stiff as these substeps allow.
void solveHarder(StepSettings& s) {
    constexpr uint32_t kTimes = 4, kMostSubsteps = 64;
    s.substeps = std::min(kTimes * s.substeps, kMostSubsteps);
    s.contact_hertz *= kTimes;
    s.hard_solver = true;
}

} // namespace

Result<StepSettings> settingsOf(const SceneDescription& scene) {
    const auto effects = resolve(scene.effects);
    if (!effects) return effects.error();
    const auto has = [&](Effect effect) { return effects->set.has(effect); };
    StepSettings s;
    s.gravity = has(Effect::Gravity) ? scene.gravity : Double3{0, 0, 0};
    s.dt = scene.step.dt;
    s.substeps = scene.step.substeps;
    s.most_substeps = scene.step.most_substeps;
    s.iterations = scene.step.iterations;
    s.contacts = has(Effect::Contacts);
    s.friction = has(Effect::Friction);
    s.restitution = has(Effect::Restitution);
    s.ccd = has(Effect::Ccd);
    s.sleeping = has(Effect::Sleeping);
    s.drag = has(Effect::Drag);
    s.impact_fracture = has(Effect::ImpactFracture);
    s.refracture = has(Effect::Refracture);
    s.events = has(Effect::Events);
    s.dust = has(Effect::Dust);
    s.debris_lifetime = has(Effect::DebrisLifetime);
    s.debris_room = has(Effect::DebrisRoom);
    s.smallest_piece = scene.breaking.smallest_piece;
    s.dust_lifetime = scene.dust.lifetime;
    s.debris_below = scene.debris.below;
    s.debris_after = scene.debris.after;
    s.debris_fade = scene.debris.fade;
    s.impact_speed = scene.events.impact_speed;
    s.air_density = scene.air_density;
    s.drag_coefficient = scene.drag_coefficient;
    s.contact_hertz = scene.step.contact_hertz;
    s.contact_damping = scene.step.contact_damping;
    s.push_out = scene.step.push_out;
    s.margin = scene.step.margin;
    s.recycling = scene.step.recycling;
    s.fixed_axes = scene.step.axes == AxisKind::Fixed ? 26 : 0;
    s.bounce_speed = scene.step.bounce_speed;
    if (scene.step.solver == SolverKind::Hard) solveHarder(s);
    return s;
}

WorldBudget budgetOf(const SceneDescription& scene, uint32_t group_size) {
    const BudgetDescription& b = scene.budgets;
    WorldBudget budget = {b.pairs, b.contacts, group_size, {}};
    budget.breaking = {.fragments = b.fragments,
                       .faces = b.fragment_faces,
                       .triangles = b.fragment_triangles,
                       .step_bodies = b.breaking_bodies,
                       .step_triangles = b.breaking_triangles,
                       .step_sites = b.breaking_sites,
                       .most_fragments = b.most_fragments,
                       .particles = b.dust};
    return budget;
}

} // namespace brittle
