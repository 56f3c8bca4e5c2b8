#include "modules/brittle/abi/conversions.h"

namespace brittle::abi {
namespace {

constexpr uint32_t kMostPoints = 1'000'000, kMostCells = 4096;

constexpr std::pair<BrittleEffect, Effect> kEffects[] = {{BRITTLE_EFFECT_GRAVITY, Effect::Gravity},
                                                         {BRITTLE_EFFECT_CONTACTS, Effect::Contacts},
                                                         {BRITTLE_EFFECT_FRICTION, Effect::Friction},
                                                         {BRITTLE_EFFECT_RESTITUTION, Effect::Restitution},
                                                         {BRITTLE_EFFECT_CCD, Effect::Ccd},
                                                         {BRITTLE_EFFECT_SLEEPING, Effect::Sleeping},
                                                         {BRITTLE_EFFECT_IMPACT_FRACTURE, Effect::ImpactFracture},
                                                         {BRITTLE_EFFECT_REFRACTURE, Effect::Refracture},
                                                         {BRITTLE_EFFECT_DUST, Effect::Dust},
                                                         {BRITTLE_EFFECT_DEBRIS_LIFETIME, Effect::DebrisLifetime},
                                                         {BRITTLE_EFFECT_EVENTS, Effect::Events},
                                                         {BRITTLE_EFFECT_DRAG, Effect::Drag},
                                                         {BRITTLE_EFFECT_DEBRIS_ROOM, Effect::DebrisRoom}};

std::vector<std::string> effectNames(uint32_t bits) {
    std::vector<std::string> names;
    for (const auto& [bit, effect] : kEffects) {
        if ((bits & bit) != 0) names.emplace_back(nameOf(effect));
        bits &= ~static_cast<uint32_t>(bit);
    }
    if (bits != 0) throw Refusal(BRITTLE_BAD_VALUE, "'effects' has bits that are no BRITTLE_EFFECT_...");
    return names;
}

BudgetDescription budgetOf(const BrittleBudget& b) {
    BudgetDescription budget;
    budget.pairs = b.pairs;
    budget.contacts = b.contacts;
    budget.fragments = b.fragments;
    budget.fragment_faces = b.fragment_faces;
    budget.fragment_triangles = b.fragment_triangles;
    budget.most_fragments = b.most_fragments;
    budget.breaking_bodies = b.breaking_bodies;
    budget.breaking_sites = b.breaking_sites;
    budget.breaking_triangles = b.breaking_triangles;
    if (b.dust != 0) budget.dust = b.dust;
    return budget;
}

void setPoints(const BrittleShape& shape, ShapeDescription& d) {
    if (shape.point_count > kMostPoints) throw Refusal(BRITTLE_BAD_VALUE, "a hull has at most 1,000,000 points");
    if (shape.point_count > 0) needed(shape.points, "points");
    for (uint32_t k = 0; k < shape.point_count; ++k)
        d.points.push_back(tripleOf(shape.points[k]));
}

void setMesh(const BrittleContext& c, const BrittleShape& shape, bool moves, ShapeDescription& d) {
    const HostedMesh& mesh = c.meshes.at(shape.mesh.id);
    if (moves && mesh.is_open) throw Refusal(BRITTLE_BAD_MESH, "a mesh that was made as an open one is for colliders only");
    if (moves && (shape.cells == 0 || shape.cells > kMostCells))
        throw Refusal(BRITTLE_BAD_VALUE, "'cells' has to be from 1 (of a convex mesh) to 4096");
    d.model = mesh.model;
    if (moves) d.cells.sites = shape.cells;
}

// By the material's id, so that a world has each once.
std::string materialIn(const BrittleContext& c, HostedWorld& world, BrittleMaterial material) {
    const MaterialDescription& card = c.materials.at(material.id);
    const auto [known, is_new] = world.material_names.try_emplace(material.id);
    if (is_new) {
        known->second = "material_" + std::to_string(world.scene.materials.size());
        world.scene.materials.push_back(card);
        world.scene.materials.back().name = known->second;
    }
    return known->second;
}

} // namespace

SceneDescription sceneOf(const BrittleWorldDef& def) {
    SceneDescription scene;
    scene.effects = effectNames(def.effects);
    scene.gravity = tripleOf(def.gravity);
    scene.step.dt = def.dt;
    scene.step.substeps = def.substeps;
    scene.step.iterations = def.iterations;
    scene.breaking.smallest_piece = def.smallest_piece;
    scene.dust.lifetime = def.dust_lifetime;
    scene.debris = {def.debris_below, def.debris_after, def.debris_fade};
    scene.events = {def.impact_speed};
    scene.air_density = def.air_density;
    scene.drag_coefficient = def.drag_coefficient;
    scene.budgets = budgetOf(def.budget);
    return scene;
}

ShapeDescription shapeOf(const BrittleContext& c, const BrittleShape& shape, bool moves) {
    ShapeDescription d;
    switch (shape.kind) {
    case BRITTLE_SHAPE_BOX:
        d.kind = ShapeKind::Box;
        d.size = tripleOf(shape.size);
        return d;
    case BRITTLE_SHAPE_BALL:
        d.kind = ShapeKind::Ball;
        d.radius = shape.radius;
        d.corners = shape.corners;
        return d;
    case BRITTLE_SHAPE_HULL:
        d.kind = ShapeKind::Hull;
        setPoints(shape, d);
        return d;
    case BRITTLE_SHAPE_MESH:
        d.kind = ShapeKind::Mesh;
        setMesh(c, shape, moves, d);
        return d;
    case BRITTLE_SHAPE_PLANE:
        d.kind = ShapeKind::Plane;
        if (moves) throw Refusal(BRITTLE_BAD_VALUE, "a plane does not move; add it as a collider");
        return d;
    default: throw Refusal(BRITTLE_BAD_VALUE, "'kind' of a shape is no BRITTLE_SHAPE_...");
    }
}

BodyDescription bodyOf(const BrittleContext& c, HostedWorld& world, const BrittleBodyDef& def) {
    BodyDescription body;
    body.shape = shapeOf(c, def.shape, true);
    body.place = tripleOf(def.position);
    body.turn = turnOf(def.rotation);
    body.velocity = tripleOf(def.velocity);
    body.spin = tripleOf(def.spin);
    if (def.density != 0) body.density = def.density;
    if (def.mass != 0) body.mass = def.mass;
    body.surface = {def.friction, def.restitution};
    body.fixed = def.is_fixed != 0;
    if (def.pattern > BRITTLE_PATTERN_RADIAL) throw Refusal(BRITTLE_BAD_VALUE, "'pattern' is no BRITTLE_PATTERN_...");
    body.break_pattern = static_cast<BreakPattern>(def.pattern);
    if (def.material.id != 0) body.material = materialIn(c, world, def.material);
    return body;
}

ColliderDescription colliderOf(const BrittleContext& c, const BrittleColliderDef& def) {
    ColliderDescription collider;
    collider.shape = shapeOf(c, def.shape, false);
    collider.place = tripleOf(def.position);
    collider.turn = turnOf(def.rotation);
    collider.surface = {def.friction, def.restitution};
    return collider;
}

} // namespace brittle::abi
