// What the engine and its inspector know of BrittleBody3D.
#include "modules/brittle/godot/nodes/brittle_body.h"
#include "modules/brittle/godot/nodes/field_property.h"

namespace brittle_godot {
namespace {

using B = BodyNode;

void describeShape(ClassRecord& r) {
    r.group("Shape");
    countProperty<B>(r, "kind", {kHintEnum, "Moving:0,Fixed until it breaks:1,Collider:2"},
                     [](B& b) -> uint32_t& { return b.settings().kind; });
    countProperty<B>(r, "shape", {kHintEnum, "Mesh:0,Convex hull:1,Box:2,Ball:3,Plane:4"},
                     [](B& b) -> uint32_t& { return b.settings().shape; });
    countProperty<B>(r, "cells", range("0,4096,1"), [](B& b) -> uint32_t& { return b.settings().cells; });
    r.property(
        "copies", Type::Object, {kHintResourceType, "MultiMesh"},
        [](Instance& i, const Value& v) { static_cast<B&>(i).setCopies(v); },
        [](Instance& i) { return static_cast<B&>(i).settings().copies; });
}

void describeBreaking(ClassRecord& r) {
    r.group("Breaking");
    resourceProperty<B>(r, "brittle_material", "BrittleMaterial", [](B& b) -> Value& { return b.settings().material; });
    countProperty<B>(r, "pattern", {kHintEnum, "Impact:0,Uniform:1,Radial:2"},
                     [](B& b) -> uint32_t& { return b.settings().pattern; });
}

void describeMotion(ClassRecord& r) {
    r.group("Motion");
    numberProperty<B>(r, "density", "0,20000,1,or_greater,suffix:kg/m³", [](B& b) -> double& { return b.settings().density; });
    numberProperty<B>(r, "mass", "0,1000,0.001,or_greater,exp,suffix:kg", [](B& b) -> double& { return b.settings().mass; });
    numberProperty<B>(r, "friction", "0,2,0.01,or_greater", [](B& b) -> double& { return b.settings().friction; });
    numberProperty<B>(r, "restitution", "0,1,0.01", [](B& b) -> double& { return b.settings().restitution; });
    r.property(
        "linear_velocity", Type::Vector3, {kHintNone, "suffix:m/s"},
        [](Instance& i, const Value& v) { static_cast<B&>(i).settings().velocity = v.asVec3(); },
        [](Instance& i) { return Value(static_cast<B&>(i).settings().velocity); });
    r.property(
        "angular_velocity", Type::Vector3, {kHintNone, "suffix:rad/s"},
        [](Instance& i, const Value& v) { static_cast<B&>(i).settings().spin = v.asVec3(); },
        [](Instance& i) { return Value(static_cast<B&>(i).settings().spin); });
}

void describeSignals(ClassRecord& r) {
    r.signal("fractured", {{"position", Type::Vector3},
                           {"normal", Type::Vector3},
                           {"speed", Type::Float},
                           {"energy", Type::Float},
                           {"fragments", Type::Int},
                           {"by", Type::Object, "BrittleBody3D"},
                           {"copy", Type::Int}});
    r.signal("impact", {{"position", Type::Vector3},
                        {"normal", Type::Vector3},
                        {"speed", Type::Float},
                        {"energy", Type::Float},
                        {"by", Type::Object, "BrittleBody3D"},
                        {"copy", Type::Int}});
}

void describeConstants(ClassRecord& r) {
    r.constant("Kind", "KIND_MOVING", 0);
    r.constant("Kind", "KIND_FIXED", 1);
    r.constant("Kind", "KIND_COLLIDER", 2);
    r.constant("Shape", "SHAPE_MESH", 0);
    r.constant("Shape", "SHAPE_HULL", 1);
    r.constant("Shape", "SHAPE_BOX", 2);
    r.constant("Shape", "SHAPE_BALL", 3);
    r.constant("Shape", "SHAPE_PLANE", 4);
    r.constant("Pattern", "PATTERN_IMPACT", BRITTLE_PATTERN_IMPACT);
    r.constant("Pattern", "PATTERN_UNIFORM", BRITTLE_PATTERN_UNIFORM);
    r.constant("Pattern", "PATTERN_RADIAL", BRITTLE_PATTERN_RADIAL);
}

} // namespace

void BodyNode::describe(ClassRecord& r) {
    describeShape(r);
    describeBreaking(r);
    describeMotion(r);
    r.method("is_whole", {{"copy", Type::Int}}, {"", Type::Bool},
             [](Instance& i, Arguments a) { return Value(static_cast<B&>(i).isWhole(static_cast<size_t>(a[0].asInt()))); });
    describeSignals(r);
    describeConstants(r);
}

} // namespace brittle_godot
