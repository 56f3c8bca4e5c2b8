// The engine's own classes, as far as the plugin asks anything of them. What they keep lies in their objects' fields.
#include "tests/godot/fake_engine.h"

#include <algorithm>

namespace godot_test {
namespace {

using Arguments = std::vector<Any>;
using Body = std::function<Any(FakeEngine&, Object&, const Arguments&)>;

constexpr std::array<float, 12> kIdentity = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

Body gives(const char* field, const Any& otherwise) {
    return [field, otherwise](FakeEngine&, Object& o, const Arguments&) {
        return o.fields.contains(field) ? o.fields.at(field) : otherwise;
    };
}
Body takesField(const char* field) {
    return [field](FakeEngine&, Object& o, const Arguments& a) {
        o.fields[field] = a[0];
        return Any();
    };
}

std::array<float, 12> transformOf(const Object& node) {
    return node.fields.contains("transform") ? node.fields.at("transform").asTransform() : kIdentity;
}

// Nodes of these tests hang below others that do not turn or scale.
Any globalTransform(FakeEngine&, Object& node, const Arguments&) {
    auto t = transformOf(node);
    for (const Object* p = node.parent; p != nullptr; p = p->parent)
        for (size_t k = 9; k < t.size(); ++k)
            t[k] += transformOf(*p)[k];
    return Any::transform(t);
}
Any setGlobalTransform(FakeEngine&, Object& node, const Arguments& a) {
    auto t = a[0].asTransform();
    for (const Object* p = node.parent; p != nullptr; p = p->parent)
        for (size_t k = 9; k < t.size(); ++k)
            t[k] -= transformOf(*p)[k];
    node.fields["transform"] = Any::transform(t);
    return {};
}

Any children(FakeEngine&, Object& node, const Arguments&) {
    Arguments list;
    for (Object* child : node.children)
        list.emplace_back(child);
    return Any::array(list);
}

// Signals have to be announced, with as many arguments of those types.
Any emitSignal(FakeEngine& e, Object& object, const Arguments& a) {
    Emission emission = {object.id, a[0].asText(), {a.begin() + 1, a.end()}};
    const auto& signals = object.extension->signals;
    const auto known = signals.find(emission.name);
    bool is_right = known != signals.end() && known->second.size() == emission.arguments.size();
    for (size_t k = 0; is_right && k < emission.arguments.size(); ++k) {
        const Type asked = known->second[k].type, given = emission.arguments[k].type();
        is_right = given == asked || (asked == Type::Object && given == Type::Nil);
    }
    if (!is_right) complain("the signal " + emission.name + " is emitted otherwise than it was announced");
    e.emissions.push_back(emission);
    if (e.listener) e.listener(emission);
    return {};
}

Any world3d(FakeEngine& e, Object& node, const Arguments&) {
    if (!node.is_in_tree) complain("a node out of the tree has no world");
    return e.singleton("World3D");
}

Any newInstance(FakeEngine& e, Object&, const Arguments&) {
    const uint64_t id = e.nextId();
    e.instances[id] = {};
    return Any::rid(id);
}
Instance3d& instanceAt(FakeEngine& e, const Any& rid) {
    const auto found = e.instances.find(rid.asRid());
    static Instance3d none;
    if (found == e.instances.end()) complain("an instance is used that is none, or is gone");
    return found == e.instances.end() ? none : found->second;
}
Any freeRid(FakeEngine& e, Object&, const Arguments& a) {
    if (e.instances.erase(a[0].asRid()) != 1) complain("what is freed is no instance, or is gone");
    return {};
}

Any renderingDevice(FakeEngine& e, Object&, const Arguments&) {
    return e.driver_resources.empty() ? Any() : Any(e.singleton("RenderingDevice"));
}
Any driverResource(FakeEngine& e, Object&, const Arguments& a) {
    if (!e.isOnRenderThread()) complain("the device is asked on another thread than it is of");
    return static_cast<int64_t>(e.driver_resources.at(static_cast<size_t>(a[0].asInt())));
}

Any surfaceCount(FakeEngine&, Object& mesh, const Arguments&) {
    return static_cast<int64_t>(mesh.fields.contains("surfaces") ? mesh.fields.at("surfaces").size() : 0);
}
Any addSurface(FakeEngine&, Object& mesh, const Arguments& a) {
    constexpr size_t kArrays = 13;
    const auto arrays = a[1].asArray();
    if (arrays.size() != kArrays || arrays[0].size() == 0 || arrays[0].size() % 3 != 0)
        complain("a surface is added that is none");
    auto surfaces = mesh.fields.contains("surfaces") ? mesh.fields.at("surfaces").asArray() : Arguments();
    surfaces.push_back(a[1]);
    mesh.fields["surfaces"] = Any::array(surfaces);
    return {};
}
Any surfaceArrays(FakeEngine&, Object& mesh, const Arguments& a) {
    return mesh.fields.at("surfaces").asArray().at(static_cast<size_t>(a[0].asInt()));
}

Any duplicate(FakeEngine& e, Object& resource, const Arguments&) {
    Object* copy = e.make(resource.class_name);
    copy->fields = resource.fields;
    return copy;
}

std::map<std::string, EngineMethod> nodeMethods() {
    const auto always = [](const Any& value) { return [value](FakeEngine&, Object&, const Arguments&) { return value; }; };
    return {
        {"Object.to_string", {{}, [](FakeEngine&, Object& o, const Arguments&) { return Any("<" + o.class_name + ">"); }}},
        {"Object.is_class",
         {{Type::String}, [](FakeEngine& e, Object& o, const Arguments& a) { return Any(e.isA(o, a[0].asText())); }}},
        {"Object.emit_signal", {{Type::String}, emitSignal}},
        {"Node.get_children", {{}, children}},
        {"Node.is_inside_tree", {{}, [](FakeEngine&, Object& o, const Arguments&) { return Any(o.is_in_tree); }}},
        {"Node.set_physics_process_internal", {{Type::Bool}, takesField("processes")}},
        {"Node.get_physics_process_delta_time", {{}, [](FakeEngine& e, Object&, const Arguments&) { return physicsDelta(e); }}},
        {"Node3D.get_global_transform", {{}, globalTransform}},
        {"Node3D.set_global_transform", {{Type::Transform3d}, setGlobalTransform}},
        {"Node3D.get_transform", {{}, gives("transform", Any::transform(kIdentity))}},
        {"Node3D.set_transform", {{Type::Transform3d}, takesField("transform")}},
        {"Node3D.get_world_3d", {{}, world3d}},
        {"Node3D.is_visible_in_tree", {{}, gives("visible", Any(true))}},
        {"VisualInstance3D.set_base", {{Type::Rid}, takesField("base")}},
        {"VisualInstance3D.get_layer_mask", {{}, always(Any(1))}},
        {"GeometryInstance3D.get_cast_shadows_setting", {{}, always(Any(1))}},
        {"GeometryInstance3D.get_material_override", {{}, gives("material_override", Any())}},
        {"MeshInstance3D.get_mesh", {{}, gives("mesh", Any())}},
        {"MeshInstance3D.set_mesh", {{Type::Object}, takesField("mesh")}},
        {"MeshInstance3D.get_active_material", {{Type::Int}, always(Any())}}};
}

std::map<std::string, EngineMethod> serverMethods() {
    return {{"Engine.is_editor_hint", {{}, [](FakeEngine& e, Object&, const Arguments&) { return Any(e.is_editor); }}},
            {"World3D.get_scenario", {{}, [](FakeEngine&, Object&, const Arguments&) { return Any::rid(7); }}},
            {"RenderingServer.get_rendering_device", {{}, renderingDevice}},
            {"RenderingServer.get_current_rendering_driver_name",
             {{}, [](FakeEngine& e, Object&, const Arguments&) { return Any(e.driver); }}},
            {"RenderingServer.call_on_render_thread",
             {{Type::Callable},
              [](FakeEngine& e, Object&, const Arguments& a) {
                  e.runOnRenderThread(a[0]);
                  return Any();
              }}},
            {"RenderingServer.instance_create2", {{Type::Rid, Type::Rid}, newInstance}},
            {"RenderingServer.instance_set_transform",
             {{Type::Rid, Type::Transform3d},
              [](FakeEngine& e, Object&, const Arguments& a) {
                  instanceAt(e, a[0]).transform = a[1].asTransform();
                  return Any();
              }}},
            {"RenderingServer.instance_set_visible",
             {{Type::Rid, Type::Bool},
              [](FakeEngine& e, Object&, const Arguments& a) { return Any(instanceAt(e, a[0]).is_visible = a[1].asBool()); }}},
            {"RenderingServer.instance_set_layer_mask",
             {{Type::Rid, Type::Int},
              [](FakeEngine& e, Object&, const Arguments& a) { return Any(instanceAt(e, a[0]).layers = a[1].asInt()); }}},
            {"RenderingServer.instance_geometry_set_cast_shadows_setting",
             {{Type::Rid, Type::Int},
              [](FakeEngine& e, Object&, const Arguments& a) { return Any(instanceAt(e, a[0]).shadows = a[1].asInt()); }}},
            {"RenderingServer.free_rid", {{Type::Rid}, freeRid}},
            {"RenderingDevice.get_driver_resource", {{Type::Int, Type::Rid, Type::Int}, driverResource}}};
}

std::map<std::string, EngineMethod> resourceMethods() {
    const auto nothing = [](FakeEngine&, Object&, const Arguments&) { return Any(); };
    return {{"Resource.get_rid", {{}, [](FakeEngine&, Object& o, const Arguments&) { return Any::rid(o.id); }}},
            {"Resource.duplicate", {{}, duplicate}},
            {"Mesh.get_surface_count", {{}, surfaceCount}},
            {"Mesh.surface_get_arrays", {{Type::Int}, surfaceArrays}},
            {"Mesh.surface_get_material", {{Type::Int}, nothing}},
            {"Mesh.surface_set_material", {{Type::Int, Type::Object}, takesField("material")}},
            {"ArrayMesh.surface_get_primitive_type", {{Type::Int}, gives("primitive", Any(3))}},
            {"ArrayMesh.add_surface_from_arrays", {{Type::Int, Type::Array}, addSurface}},
            {"ArrayMesh.surface_set_name", {{Type::Int, Type::String}, nothing}},
            {"MultiMesh.get_mesh", {{}, gives("mesh", Any())}},
            {"MultiMesh.is_using_colors", {{}, gives("colors", Any(false))}},
            {"MultiMesh.is_using_custom_data", {{}, gives("data", Any(false))}},
            {"MultiMesh.get_transform_format", {{}, gives("format", Any(1))}},
            {"MultiMesh.get_instance_count", {{}, gives("count", Any(0))}},
            {"MultiMesh.get_buffer", {{}, gives("buffer", Any::packed(Type::PackedFloat32Array, nullptr, 0))}},
            {"MultiMesh.set_buffer", {{Type::PackedFloat32Array}, takesField("buffer")}}};
}

} // namespace

// Made anew for each engine, so that what they keep is not on the ledger when there is none.
const std::map<std::string, EngineMethod>& engineMethods() {
    static const std::map<std::string, EngineMethod> methods = [] {
        auto all = nodeMethods();
        all.merge(serverMethods());
        all.merge(resourceMethods());
        return all;
    }();
    return methods;
}

std::string parentOf(const std::string& class_name) {
    static const std::map<std::string, std::string> parents = {{"RefCounted", "Object"},
                                                               {"Resource", "RefCounted"},
                                                               {"Mesh", "Resource"},
                                                               {"ArrayMesh", "Mesh"},
                                                               {"BoxMesh", "Mesh"},
                                                               {"MultiMesh", "Resource"},
                                                               {"Material", "Resource"},
                                                               {"World3D", "Object"},
                                                               {"Node", "Object"},
                                                               {"Node3D", "Node"},
                                                               {"VisualInstance3D", "Node3D"},
                                                               {"GeometryInstance3D", "VisualInstance3D"},
                                                               {"MeshInstance3D", "GeometryInstance3D"},
                                                               {"RenderingServer", "Object"},
                                                               {"RenderingDevice", "Object"},
                                                               {"Engine", "Object"}};
    const auto found = parents.find(class_name);
    return found == parents.end() ? "" : found->second;
}

Object* boxMesh(FakeEngine& e, float x, float y, float z) {
    constexpr int32_t kFaces[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
    std::vector<float> positions;
    std::vector<int32_t> indices;
    for (int k = 0; k < 8; ++k)
        for (const float p : {(k & 1) != 0 ? x : -x, (k & 2) != 0 ? y : -y, (k & 4) != 0 ? z : -z})
            positions.push_back(p / 2);
    for (const auto& f : kFaces)
        for (const int32_t corner : {f[0], f[1], f[2], f[0], f[2], f[3]})
            indices.push_back(corner);
    Arguments arrays(13);
    arrays[0] = Any::packed(Type::PackedVector3Array, positions.data(), positions.size() / 3);
    arrays[12] = Any::packed(Type::PackedInt32Array, indices.data(), indices.size());
    Object* mesh = e.make("ArrayMesh");
    mesh->fields["surfaces"] = Any::array({Any::array(arrays)});
    return mesh;
}

} // namespace godot_test
