#include "modules/brittle/godot/nodes/fragments.h"

#include "modules/brittle/godot/conversion/mesh_out.h"
#include "modules/brittle/godot/conversion/placement.h"

#include <algorithm>

namespace brittle_godot {
namespace {

// Debris that fades shrinks about its center of mass.
Transform placeOf(const BrittleBodyState& state) {
    Transform shrunk;
    for (int k = 0; k < 3; ++k)
        shrunk.basis[k][k] = static_cast<float>(state.left);
    return transformOf(state.position, state.rotation, shrunk);
}

} // namespace

Fragments::Fragments() : server_(singleton("RenderingServer")) {}

void Fragments::clear() {
    for (auto& [id, fragment] : drawn_)
        server_.call("free_rid", {fragment.instance});
    drawn_.clear();
}

void Fragments::setVisible(bool is_visible) {
    is_visible_ = is_visible;
    for (auto& [id, fragment] : drawn_)
        server_.call("instance_set_visible", {fragment.instance, is_visible});
}

void Fragments::add(const FragmentSurface& surface, size_t link, const BodyNode& origin) {
    DrawnFragment fragment;
    fragment.link = link;
    fragment.mesh = arrayMeshOf(surface, origin.outerMaterial(), origin.cutMaterial());
    const Value node = origin.self();
    const Value scenario = node.call("get_world_3d").call("get_scenario");
    fragment.instance = server_.call("instance_create2", {fragment.mesh.call("get_rid"), scenario});
    if (fragment.instance.isNull()) return; // and that has been told
    server_.call("instance_set_layer_mask", {fragment.instance, node.call("get_layer_mask")});
    server_.call("instance_geometry_set_cast_shadows_setting", {fragment.instance, node.call("get_cast_shadows_setting")});
    server_.call("instance_set_visible", {fragment.instance, is_visible_});
    drawn_.insert_or_assign(surface.id, std::move(fragment));
}

void Fragments::beginPlacing() {
    for (auto& [id, fragment] : drawn_)
        fragment.is_seen = false;
}

// What slept before and sleeps now lies where it lay.
void Fragments::place(const BrittleBodyState& state) {
    const auto found = drawn_.find(state.body.id);
    if (found == drawn_.end()) return;
    DrawnFragment& fragment = found->second;
    const bool rests = fragment.is_asleep && state.is_asleep != 0 && state.left == 1;
    fragment.is_seen = true;
    fragment.is_asleep = state.is_asleep != 0;
    if (rests) return;
    fragment.place = placeOf(state);
    server_.call("instance_set_transform", {fragment.instance, fragment.place});
}

void Fragments::endPlacing() {
    std::erase_if(drawn_, [&](auto& entry) {
        if (!entry.second.is_seen) server_.call("free_rid", {entry.second.instance});
        return !entry.second.is_seen;
    });
}

const DrawnFragment* Fragments::find(uint64_t id) const {
    const auto found = drawn_.find(id);
    return found == drawn_.end() ? nullptr : &found->second;
}

std::vector<int64_t> Fragments::ids() const {
    std::vector<int64_t> ids;
    for (const auto& [id, fragment] : drawn_)
        ids.push_back(static_cast<int64_t>(id));
    std::ranges::sort(ids);
    return ids;
}

} // namespace brittle_godot
