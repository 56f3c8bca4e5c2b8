// What the engine and its inspector know of BrittleWorld3D.
#include "modules/brittle/godot/nodes/brittle_world.h"
#include "modules/brittle/godot/nodes/budgets.h"
#include "modules/brittle/godot/nodes/field_property.h"

namespace brittle_godot {
namespace {

using W = WorldNode;

W& of(Instance& i) { return static_cast<W&>(i); }

const DrawnFragment& fragmentIn(W& world, const Value& id) {
    const DrawnFragment* fragment =
        world.fragments() == nullptr ? nullptr : world.fragments()->find(static_cast<uint64_t>(id.asInt()));
    if (fragment == nullptr) throw Failure("there is no fragment " + std::to_string(id.asInt()) + " (any more)");
    return *fragment;
}

void describeSimulation(ClassRecord& r) {
    r.property(
        "active", Type::Bool, {}, [](Instance& i, const Value& v) { of(i).is_active = v.asBool(); },
        [](Instance& i) { return Value(of(i).is_active); });
    countProperty<W>(r, "device", {kHintEnum, "Engine's if there is one:0,Own:1"}, [](W& w) -> uint32_t& { return w.device; });
    countProperty<W>(r, "effects",
                     {kHintFlags, "Gravity:1,Contacts:2,Friction:4,Restitution:8,Fast bodies:16,Sleeping:32,Impact "
                                  "fracture:64,Fragments break:128,Dust:256,Debris goes:512,Events:1024,Drag:2048,Debris makes "
                                  "room:4096"},
                     [](W& w) -> uint32_t& { return w.def.effects; });
    r.property(
        "gravity", Type::Vector3, {kHintNone, "suffix:m/s²"},
        [](Instance& i, const Value& v) { of(i).def.gravity = toBrittle(v.asVec3()); },
        [](Instance& i) { return Value(toEngine(of(i).def.gravity)); });
    numberProperty<W>(r, "step_seconds", "0.0005,0.1,0.0001,or_greater,or_less,suffix:s",
                      [](W& w) -> double& { return w.def.dt; });
    countProperty<W>(r, "substeps", range("1,64,1"), [](W& w) -> uint32_t& { return w.def.substeps; });
    countProperty<W>(r, "iterations", range("1,64,1"), [](W& w) -> uint32_t& { return w.def.iterations; });
}

void describeBreaking(ClassRecord& r) {
    r.group("Breaking");
    r.property(
        "random_seed", Type::Int, {}, [](Instance& i, const Value& v) { of(i).def.seed = static_cast<uint64_t>(v.asInt()); },
        [](Instance& i) { return Value(static_cast<int64_t>(of(i).def.seed)); });
    numberProperty<W>(r, "smallest_piece", "0,0.1,0.0001,or_greater,suffix:m",
                      [](W& w) -> double& { return w.def.smallest_piece; });
    r.group("Dust, debris, air");
    numberProperty<W>(r, "dust_lifetime", "0,60,0.1,or_greater,suffix:s", [](W& w) -> double& { return w.def.dust_lifetime; });
    numberProperty<W>(r, "debris_below", "0,1,0.001,or_greater,suffix:m", [](W& w) -> double& { return w.def.debris_below; });
    numberProperty<W>(r, "debris_after", "0,60,0.1,or_greater,suffix:s", [](W& w) -> double& { return w.def.debris_after; });
    numberProperty<W>(r, "debris_fade", "0,60,0.1,or_greater,suffix:s", [](W& w) -> double& { return w.def.debris_fade; });
    numberProperty<W>(r, "impact_speed", "0.001,10,0.001,or_greater,suffix:m/s",
                      [](W& w) -> double& { return w.def.impact_speed; });
    numberProperty<W>(r, "air_density", "0,10,0.001,or_greater,suffix:kg/m³",
                      [](W& w) -> double& { return w.def.air_density; });
    numberProperty<W>(r, "drag_coefficient", "0,5,0.01,or_greater", [](W& w) -> double& { return w.def.drag_coefficient; });
}

void describeBudget(ClassRecord& r) {
    r.group("Budget, 0: chosen", "budget_");
    for (const auto& [name, amount] : kBudgets)
        countProperty<W>(r, name, range("0,65536,1,or_greater"),
                         [amount = amount](W& w) -> uint32_t& { return w.def.budget.*amount; });
}

void describeRunning(ClassRecord& r) {
    r.method("start", {}, {"", Type::Bool}, [](Instance& i, Arguments) { return Value(of(i).start()); });
    r.method("restart", {}, {"", Type::Bool}, [](Instance& i, Arguments) { return Value(of(i).restart()); });
    r.method("is_started", {}, {"", Type::Bool}, [](Instance& i, Arguments) { return Value(of(i).isStarted()); });
    r.method("step", {{"steps", Type::Int}}, {"", Type::Bool},
             [](Instance& i, Arguments a) { return Value(of(i).step(a[0].asInt())); });
    r.method("damage", {{"point", Type::Vector3}, {"radius", Type::Float}, {"energy", Type::Float}}, {"", Type::Bool},
             [](Instance& i, Arguments a) { return Value(of(i).damage(a[0].asVec3(), a[1].asFloat(), a[2].asFloat())); });
    r.method("save_state", {}, {"", Type::PackedByteArray},
             [](Instance& i, Arguments) { return Value::packed<uint8_t>(of(i).save()); });
    r.method("restore_state", {{"state", Type::PackedByteArray}}, {"", Type::Bool},
             [](Instance& i, Arguments a) { return Value(of(i).restore(a[0].asVector<uint8_t>())); });
    r.method("hash_state", {}, {"", Type::Int}, [](Instance& i, Arguments) { return Value(of(i).hash()); });
    r.method("get_device_name", {}, {"", Type::String}, [](Instance& i, Arguments) {
        return Value(std::string_view(of(i).sharedContext() == nullptr ? "" : of(i).sharedContext()->deviceName()));
    });
    r.method("is_on_engine_device", {}, {"", Type::Bool}, [](Instance& i, Arguments) {
        return Value(of(i).sharedContext() != nullptr && of(i).sharedContext()->isOnEngineDevice());
    });
}

void describeFragments(ClassRecord& r) {
    r.method("get_fragment_count", {}, {"", Type::Int}, [](Instance& i, Arguments) {
        return Value(static_cast<int64_t>(of(i).fragments() == nullptr ? 0 : of(i).fragments()->count()));
    });
    r.method("get_fragments", {}, {"", Type::PackedInt64Array}, [](Instance& i, Arguments) {
        return Value::packed<int64_t>(of(i).fragments() == nullptr ? std::vector<int64_t>() : of(i).fragments()->ids());
    });
    r.method("get_fragment_mesh", {{"fragment", Type::Int}}, {"", Type::Object, "ArrayMesh", true},
             [](Instance& i, Arguments a) { return fragmentIn(of(i), a[0]).mesh; });
    r.method("get_fragment_transform", {{"fragment", Type::Int}}, {"", Type::Transform3d},
             [](Instance& i, Arguments a) { return Value(fragmentIn(of(i), a[0]).place); });
    r.method("get_fragment_body", {{"fragment", Type::Int}}, {"", Type::Object, "BrittleBody3D"},
             [](Instance& i, Arguments a) { return of(i).bodyOf(fragmentIn(of(i), a[0])); });
}

void describeSignals(ClassRecord& r) {
    r.signal("started", {});
    r.signal("fractured", {{"body", Type::Object, "BrittleBody3D"},
                           {"position", Type::Vector3},
                           {"normal", Type::Vector3},
                           {"speed", Type::Float},
                           {"energy", Type::Float},
                           {"fragments", Type::Int},
                           {"by", Type::Object, "BrittleBody3D"},
                           {"copy", Type::Int}});
    r.signal("impact", {{"body", Type::Object, "BrittleBody3D"},
                        {"position", Type::Vector3},
                        {"normal", Type::Vector3},
                        {"speed", Type::Float},
                        {"energy", Type::Float},
                        {"by", Type::Object, "BrittleBody3D"},
                        {"copy", Type::Int}});
}

void describeConstants(ClassRecord& r) {
    r.constant("Device", "DEVICE_ENGINE", 0);
    r.constant("Device", "DEVICE_OWN", 1);
    const auto effect = [&](const char* name, int64_t bit) { r.constant("Effect", name, bit, true); };
    effect("EFFECT_GRAVITY", BRITTLE_EFFECT_GRAVITY);
    effect("EFFECT_CONTACTS", BRITTLE_EFFECT_CONTACTS);
    effect("EFFECT_FRICTION", BRITTLE_EFFECT_FRICTION);
    effect("EFFECT_RESTITUTION", BRITTLE_EFFECT_RESTITUTION);
    effect("EFFECT_CCD", BRITTLE_EFFECT_CCD);
    effect("EFFECT_SLEEPING", BRITTLE_EFFECT_SLEEPING);
    effect("EFFECT_IMPACT_FRACTURE", BRITTLE_EFFECT_IMPACT_FRACTURE);
    effect("EFFECT_REFRACTURE", BRITTLE_EFFECT_REFRACTURE);
    effect("EFFECT_DUST", BRITTLE_EFFECT_DUST);
    effect("EFFECT_DEBRIS_LIFETIME", BRITTLE_EFFECT_DEBRIS_LIFETIME);
    effect("EFFECT_EVENTS", BRITTLE_EFFECT_EVENTS);
    effect("EFFECT_DRAG", BRITTLE_EFFECT_DRAG);
    effect("EFFECT_DEBRIS_ROOM", BRITTLE_EFFECT_DEBRIS_ROOM);
}

} // namespace

void WorldNode::describe(ClassRecord& r) {
    describeSimulation(r);
    describeBreaking(r);
    describeBudget(r);
    describeRunning(r);
    describeFragments(r);
    describeSignals(r);
    describeConstants(r);
}

} // namespace brittle_godot
