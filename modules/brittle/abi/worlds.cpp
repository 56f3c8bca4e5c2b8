#include "modules/brittle/abi/boundary.h"
#include "modules/brittle/abi/conversions.h"
#include "modules/brittle/abi/field_names.h"
#include "modules/brittle/breaking/breaking.h"
#include "modules/brittle/dynamics/scene_settings.h"
#include "modules/brittle/scene/check_scene.h"

namespace {

using namespace brittle::abi;
using brittle::SceneDescription;

// A scene has a body, and of a world that is filled bit by bit only what is new is checked.
void checkWith(SceneDescription scene) {
    scene.bodies = {brittle::BodyDescription()};
    orRefuseFields(brittle::checkScene(scene));
}

void checkCollider(const brittle::ColliderDescription& collider) {
    SceneDescription scene;
    scene.colliders = {collider};
    checkWith(scene);
}

// A body that can break, and has more triangles than a device has room for, is refused when it is added.
void checkRoomToBreak(engine::Device& device, const HostedWorld& world, const brittle::BodyDescription& body) {
    const auto effects = brittle::resolve(world.scene.effects);
    const bool breaks = effects && effects->set.has(brittle::Effect::ImpactFracture) && !body.material.empty();
    if (!breaks || !body.shape.model) return;
    const auto triangles = static_cast<uint32_t>(body.shape.model->triangles.size());
    const auto room = brittle::canBreak(device, triangles, brittle::budgetOf(world.scene).breaking);
    if (!room)
        throw Refusal(BRITTLE_CAPACITY, "body " + std::to_string(world.bodyCount()) +
                                            (body.name.empty() ? "" : " \"" + body.name + "\"") + ": " + room.error().message);
}

} // namespace

BrittleResult brittleCreateWorld(BrittleContext* context, const BrittleWorldDef* def, BrittleWorld* world) {
    return bounded(context, [&](BrittleContext& c) {
        const BrittleWorldDef& d = sized(def, "def");
        BrittleWorld& out = needed(world, "world");
        SceneDescription scene = sceneOf(d);
        checkWith(scene);
        auto settings = orRefuse(brittle::settingsOf(scene));
        orRefuseFields(brittle::checkSettings(settings));
        out.id = c.worlds.add(std::move(scene), d, &c.memory);
        c.worlds.at(out.id).setNumber(c.next_world++);
    });
}

BrittleResult brittleDestroyWorld(BrittleContext* context, BrittleWorld world) {
    return bounded(context, [&](BrittleContext& c) {
        static_cast<void>(c.worlds.at(world.id));
        c.device->waitIdle();
        c.worlds.remove(world.id);
    });
}

BrittleResult brittleAddBody(BrittleContext* context, BrittleWorld world, const BrittleBodyDef* def, BrittleBody* body) {
    return bounded(context, [&](BrittleContext& c) {
        HostedWorld& w = c.worlds.at(world.id);
        const BrittleBodyDef& d = sized(def, "def");
        BrittleBody& out = needed(body, "body");
        w.mustNotRun();
        auto described = bodyOf(c, w, d);
        orRefuseFields(brittle::checkBody(described, w.scene.bodies.size(), w.scene.materials));
        checkRoomToBreak(*c.device, w, described);
        w.scene.bodies.push_back(std::move(described));
        out = w.bodyId(w.bodyCount() - 1, 0);
    });
}

BrittleResult brittleAddCollider(BrittleContext* context, BrittleWorld world, const BrittleColliderDef* def,
                                 BrittleBody* collider) {
    return bounded(context, [&](BrittleContext& c) {
        HostedWorld& w = c.worlds.at(world.id);
        const BrittleColliderDef& d = sized(def, "def");
        BrittleBody& out = needed(collider, "collider");
        w.mustNotRun();
        auto described = colliderOf(c, d);
        checkCollider(described);
        w.scene.colliders.push_back(std::move(described));
        out = w.colliderId(static_cast<uint32_t>(w.scene.colliders.size() - 1));
    });
}

BrittleResult brittleStartWorld(BrittleContext* context, BrittleWorld world) {
    return bounded(context, [&](BrittleContext& c) { c.worlds.at(world.id).start(*c.device); });
}
