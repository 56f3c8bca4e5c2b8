#include "modules/brittle/godot/nodes/gathering.h"

#include "modules/brittle/godot/conversion/convexity.h"
#include "modules/brittle/godot/conversion/mesh_in.h"
#include "modules/brittle/godot/nodes/brittle_material.h"
#include "modules/brittle/godot/nodes/brittle_world.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace brittle_godot {
namespace {

constexpr uint32_t kCellsOfOthers = 32; // that what is not convex collides by

class Gatherer {
public:
    explicit Gatherer(const BrittleWorldDef& def) { found_.plan.def = def; }

    void visit(const Value& node) {
        const Value children = node.call("get_children");
        const int64_t count = children.call("size").asInt();
        for (int64_t k = 0; k < count; ++k) {
            const Value child = children.at(k);
            if (auto* body = instanceOf<BodyNode>(child)) addNode(*body);
            if (instanceOf<WorldNode>(child) == nullptr) visit(child);
        }
    }

    Gathered take() { return std::move(found_); }

private:
    void addNode(BodyNode& node) {
        try {
            const size_t copies = node.copyCount();
            for (size_t copy = 0; copy < copies; ++copy)
                addBody(node, copy);
        } catch (const Failure& failure) {
            throw Failure(node.nodeName() + ": " + failure.what());
        }
    }

    void addBody(BodyNode& node, size_t copy) {
        const BodySettings& s = node.settings();
        const Placement placement = placementOf(node.placeOf(copy));
        if (placement.is_flat) throw Failure("its transform flattens it, or has no numbers");
        BodyPlan body;
        body.who = node.nodeName();
        body.is_collider = s.kind == static_cast<uint32_t>(BodyKind::Collider);
        body.def = brittleDefaultBodyDef();
        setMotion(s, body.def);
        body.def.position = placement.position;
        body.def.rotation = placement.rotation;
        if (!body.is_collider) body.material = materialOf(s.material);
        Link link = {&node, copy, placement.stretch};
        setShape(node, placement, body, link);
        found_.plan.bodies.push_back(std::move(body));
        found_.links.push_back(link);
    }

    static void setMotion(const BodySettings& s, BrittleBodyDef& def) {
        def.is_fixed = s.kind == static_cast<uint32_t>(BodyKind::Fixed) ? 1 : 0;
        def.velocity = toBrittle(s.velocity);
        def.spin = toBrittle(s.spin);
        def.density = s.density;
        def.mass = s.mass;
        def.friction = s.friction;
        def.restitution = s.restitution;
        def.pattern = s.pattern;
    }

    void setShape(const BodyNode& node, const Placement& placement, BodyPlan& body, Link& link) {
        const auto shape = static_cast<BodyShape>(node.settings().shape);
        if (shape == BodyShape::Plane) {
            if (!body.is_collider) throw Failure("a plane does not move: its kind has to be Collider");
            body.def.shape.kind = BRITTLE_SHAPE_PLANE;
            return;
        }
        body.mesh = meshOf(node.mesh(), placement, body.is_collider && shape == BodyShape::Mesh);
        const Triangles& triangles = found_.plan.meshes[body.mesh].triangles;
        switch (shape) {
        case BodyShape::Hull: setHull(pointsOf(triangles), body); return;
        case BodyShape::Box: setHull(cornersOf(boundsOf(triangles)), body); return;
        case BodyShape::Ball: setBall(boundsOf(triangles), body, link); return;
        default: setMesh(node.settings().cells, body);
        }
    }

    void setMesh(uint32_t cells, BodyPlan& body) {
        body.def.shape.kind = BRITTLE_SHAPE_MESH;
        body.def.shape.cells = cells != 0 ? cells : cellsOf(body.mesh);
    }

    static void setHull(std::vector<BrittleVec3> points, BodyPlan& body) {
        body.def.shape.kind = BRITTLE_SHAPE_HULL;
        body.hull = std::move(points);
        body.mesh = kNone;
    }

    // As wide as the mesh in its widest direction, about the middle of its bounds.
    static void setBall(const Bounds& b, BodyPlan& body, Link& link) {
        body.def.shape.kind = BRITTLE_SHAPE_BALL;
        body.def.shape.radius = std::max({b.most.x - b.least.x, b.most.y - b.least.y, b.most.z - b.least.z}) / 2;
        body.mesh = kNone;
        const Vec3 middle = b.middle();
        body.def.position = toBrittle(transformOf(body.def.position, body.def.rotation, movedBy(middle)).origin);
        link.from_body = product(movedBy({-middle.x, -middle.y, -middle.z}), link.from_body);
    }

    static Transform movedBy(const Vec3& by) {
        Transform t;
        t.origin = by;
        return t;
    }

    static std::vector<BrittleVec3> pointsOf(const Triangles& t) {
        std::vector<BrittleVec3> points;
        for (size_t k = 0; k < t.positions.size(); k += 3)
            points.push_back({t.positions[k], t.positions[k + 1], t.positions[k + 2]});
        return points;
    }

    static std::vector<BrittleVec3> cornersOf(const Bounds& b) {
        std::vector<BrittleVec3> corners;
        for (const float x : {b.least.x, b.most.x})
            for (const float y : {b.least.y, b.most.y})
                for (const float z : {b.least.z, b.most.z})
                    corners.push_back({x, y, z});
        return corners;
    }

    // To a millionth of the largest, so that copies that are only turned are stretched alike.
    static void round(std::array<float, 9>& stretch) {
        constexpr int kBits = 20;
        float largest = 0;
        for (const float s : stretch)
            largest = std::max(largest, std::fabs(s));
        const float step = std::ldexp(1.0f, std::ilogb(largest) - kBits);
        for (float& s : stretch)
            s = std::round(s / step) * step;
    }

    // Each mesh once for each way in which it is stretched.
    size_t meshOf(const Value& mesh, const Placement& placement, bool is_open) {
        std::array<float, 9> stretch;
        std::copy_n(&placement.stretch.basis[0][0], stretch.size(), stretch.begin());
        round(stretch);
        const auto [known, is_new] = meshes_.try_emplace({mesh.asObject(), stretch, is_open}, found_.plan.meshes.size());
        if (is_new) {
            Placement rounded = placement;
            std::copy_n(stretch.begin(), stretch.size(), &rounded.stretch.basis[0][0]);
            found_.plan.meshes.push_back({trianglesOf(mesh, rounded), is_open});
            cells_.push_back(0);
        }
        return known->second;
    }

    uint32_t cellsOf(size_t mesh) {
        if (cells_[mesh] == 0) cells_[mesh] = isConvex(found_.plan.meshes[mesh].triangles) ? 1 : kCellsOfOthers;
        return cells_[mesh];
    }

    size_t materialOf(const Value& resource) {
        const auto* material = instanceOf<MaterialResource>(resource);
        if (material == nullptr) return kNone;
        const auto [known, is_new] = materials_.try_emplace(material, found_.plan.materials.size());
        if (is_new) found_.plan.materials.push_back({material->def, material->like});
        return known->second;
    }

    Gathered found_;
    std::map<std::tuple<void*, std::array<float, 9>, bool>, size_t> meshes_;
    std::vector<uint32_t> cells_; // of each mesh of the plan, once asked
    std::map<const MaterialResource*, size_t> materials_;
};

} // namespace

Gathered gather(const Value& world, const BrittleWorldDef& def) {
    Gatherer gatherer(def);
    gatherer.visit(world);
    return gatherer.take();
}

} // namespace brittle_godot
