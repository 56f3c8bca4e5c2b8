// Definitions that are good as they are. Numbers are those of scenes, which say why.
#include "modules/brittle/brittle.h"
#include "modules/brittle/scene/scene_description.h"

namespace {

BrittleVec3 vectorOf(const brittle::Double3& v) { return {v[0], v[1], v[2]}; }

BrittleShape shapeOf(uint32_t kind) {
    const brittle::ShapeDescription usual;
    BrittleShape shape = {};
    shape.kind = kind;
    shape.size = vectorOf(usual.size);
    shape.radius = usual.radius;
    shape.corners = usual.corners;
    shape.cells = 1;
    return shape;
}

} // namespace

BrittleContextDef brittleDefaultContextDef(void) {
    BrittleContextDef def = {};
    def.struct_size = sizeof def;
    def.version = BRITTLE_VERSION;
    def.vulkan.struct_size = sizeof def.vulkan;
    return def;
}

BrittleMeshDef brittleDefaultMeshDef(void) {
    BrittleMeshDef def = {};
    def.struct_size = sizeof def;
    return def;
}

BrittleMaterialDef brittleDefaultMaterialDef(void) {
    BrittleMaterialDef def = {};
    def.struct_size = sizeof def;
    def.like = "glass";
    return def;
}

BrittleWorldDef brittleDefaultWorldDef(void) {
    const brittle::SceneDescription usual;
    BrittleWorldDef def = {};
    def.struct_size = sizeof def;
    def.effects = BRITTLE_EFFECT_GRAVITY | BRITTLE_EFFECT_CONTACTS | BRITTLE_EFFECT_FRICTION | BRITTLE_EFFECT_CCD |
                  BRITTLE_EFFECT_SLEEPING | BRITTLE_EFFECT_IMPACT_FRACTURE | BRITTLE_EFFECT_REFRACTURE | BRITTLE_EFFECT_EVENTS |
                  BRITTLE_EFFECT_DEBRIS_ROOM;
    def.gravity = vectorOf(usual.gravity);
    def.dt = usual.step.dt;
    def.substeps = usual.step.substeps;
    def.iterations = usual.step.iterations;
    def.seed = 1;
    def.smallest_piece = usual.breaking.smallest_piece;
    def.dust_lifetime = usual.dust.lifetime;
    def.debris_below = usual.debris.below;
    def.debris_after = usual.debris.after;
    def.debris_fade = usual.debris.fade;
    def.impact_speed = usual.events.impact_speed;
    def.air_density = usual.air_density;
    def.drag_coefficient = usual.drag_coefficient;
    def.has_surfaces = 1;
    return def;
}

BrittleBodyDef brittleDefaultBodyDef(void) {
    const brittle::SurfaceDescription usual;
    BrittleBodyDef def = {};
    def.struct_size = sizeof def;
    def.shape = shapeOf(BRITTLE_SHAPE_BOX);
    def.rotation = {0, 0, 0, 1};
    def.friction = usual.friction;
    def.restitution = usual.restitution;
    return def;
}

BrittleColliderDef brittleDefaultColliderDef(void) {
    const brittle::SurfaceDescription usual;
    BrittleColliderDef def = {};
    def.struct_size = sizeof def;
    def.shape = shapeOf(BRITTLE_SHAPE_PLANE);
    def.rotation = {0, 0, 0, 1};
    def.friction = usual.friction;
    def.restitution = usual.restitution;
    return def;
}
