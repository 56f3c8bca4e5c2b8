#include "modules/brittle/godot/nodes/brittle_body.h"

#include "modules/brittle/godot/conversion/placement.h"
#include "modules/brittle/godot/failure.h"
#include "modules/brittle/godot/nodes/brittle_material.h"
#include "modules/brittle/godot/nodes/brittle_world.h"

#include <algorithm>

namespace brittle_godot {
namespace {

constexpr int kNotificationEnterTree = 10;
constexpr size_t kFloatsOfPlace = 12, kFloatsOfColor = 4;

// Of a MultiMesh: the rows of the transform, each with its part of the origin.
Transform placeIn(const float* floats) {
    Transform t;
    for (int row = 0; row < 3; ++row)
        for (int k = 0; k < 3; ++k)
            t.basis[row][k] = floats[4 * row + k];
    t.origin = {floats[3], floats[7], floats[11]};
    return t;
}

void writePlace(const Transform& t, float* floats) {
    const float origin[3] = {t.origin.x, t.origin.y, t.origin.z};
    for (int row = 0; row < 3; ++row) {
        std::copy_n(t.basis[row], 3, floats + 4 * row);
        floats[4 * row + 3] = origin[row];
    }
}

} // namespace

BodyNode::BodyNode() {
    const BrittleBodyDef def = brittleDefaultBodyDef();
    settings_.friction = def.friction;
    settings_.restitution = def.restitution;
}

BodyNode::~BodyNode() {
    if (world_ != nullptr) world_->forget(*this);
}

void BodyNode::notice(int what) {
    if (what == kNotificationEnterTree && hasCopies()) self().call("set_base", {settings_.copies.call("get_rid")});
}

std::string BodyNode::nodeName() const { return self().call("to_string").asString(); }

Value BodyNode::mesh() const { return hasCopies() ? settings_.copies.call("get_mesh") : self().call("get_mesh"); }

Value BodyNode::outerMaterial() const {
    Value over = self().call("get_material_override");
    if (!over.isNull()) return over;
    if (!hasCopies()) return self().call("get_active_material", {0});
    const Value drawn = mesh();
    return drawn.isNull() ? Value() : drawn.call("surface_get_material", {0});
}

Value BodyNode::cutMaterial() const {
    const auto* material = instanceOf<MaterialResource>(settings_.material);
    return material != nullptr && !material->cut_material.isNull() ? material->cut_material : outerMaterial();
}

size_t BodyNode::strideOfCopies() const {
    const bool has_colors = settings_.copies.call("is_using_colors").asBool();
    const bool has_data = settings_.copies.call("is_using_custom_data").asBool();
    return kFloatsOfPlace + (has_colors ? kFloatsOfColor : 0) + (has_data ? kFloatsOfColor : 0);
}

// By the buffer, which the engine also has where it draws nothing.
std::vector<float> BodyNode::placesOfCopies() const {
    constexpr int kTransform3d = 1; // MultiMesh.TransformFormat
    if (settings_.copies.call("get_transform_format").asInt() != kTransform3d)
        throw Failure("its MultiMesh is not of 3D transforms");
    const auto count = static_cast<size_t>(settings_.copies.call("get_instance_count").asInt());
    std::vector<float> places = settings_.copies.call("get_buffer").asVector<float>();
    if (count == 0) throw Failure("its MultiMesh has no instances");
    if (places.size() < count * strideOfCopies())
        throw Failure("its MultiMesh tells no places; under --headless the engine keeps only those given as `buffer`");
    return places;
}

size_t BodyNode::copyCount() const { return hasCopies() ? placesOfCopies().size() / strideOfCopies() : 1; }

Transform BodyNode::placeOf(size_t copy) const {
    const Transform node = self().call("get_global_transform").asTransform();
    return hasCopies() ? product(node, placeIn(placesOfCopies().data() + copy * strideOfCopies())) : node;
}

void BodyNode::join(WorldNode* world) {
    world_ = world;
    if (world == nullptr) return;
    start_ = self().call("get_transform").asTransform();
    is_whole_.assign(copyCount(), true);
    if (!hasCopies()) return;
    places_ = start_places_ = placesOfCopies();
    stride_ = strideOfCopies();
    to_node_ = inverse(self().call("get_global_transform").asTransform());
    drawn_ = settings_.copies.call("duplicate");
    drawn_.call("set_buffer", {Value::packed<float>(places_)});
    drawWhole();
}

void BodyNode::drawWhole() {
    const Value drawn = hasCopies() ? drawn_ : mesh();
    self().call("set_base", {drawn.isNull() ? Value::empty(Type::Rid) : drawn.call("get_rid")});
}

void BodyNode::show(size_t copy, const Transform& place) {
    if (!hasCopies()) {
        if (!is_whole_[copy]) drawWhole();
        self().call("set_global_transform", {place});
    } else {
        writePlace(product(to_node_, place), places_.data() + copy * stride_);
        have_moved_ = true;
    }
    is_whole_[copy] = true;
}

// What is drawn of a copy has no size then.
void BodyNode::hide(size_t copy) {
    is_whole_[copy] = false;
    if (!hasCopies()) {
        self().call("set_base", {Value::empty(Type::Rid)});
        return;
    }
    std::fill_n(places_.begin() + static_cast<ptrdiff_t>(copy * stride_), kFloatsOfPlace, 0.0f);
    have_moved_ = true;
}

void BodyNode::finishMoves() {
    if (have_moved_) drawn_.call("set_buffer", {Value::packed<float>(places_)});
    have_moved_ = false;
}

void BodyNode::returnToStart() {
    self().call("set_transform", {start_});
    places_ = start_places_;
    is_whole_.assign(is_whole_.size(), true);
    have_moved_ = hasCopies();
    finishMoves();
    drawWhole();
}

void BodyNode::setCopies(const Value& copies) {
    settings_.copies = copies;
    if (self().call("is_inside_tree").asBool())
        self().call("set_base", {copies.isNull() ? Value::empty(Type::Rid) : copies.call("get_rid")});
}

} // namespace brittle_godot
