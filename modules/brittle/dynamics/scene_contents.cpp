#include "modules/brittle/dynamics/scene_contents.h"

#include "modules/brittle/mesh/import.h"
#include "modules/brittle/mesh/prepare.h"
#include "modules/brittle/mesh/primitives.h"
#include "modules/brittle/scene/body_shape.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace brittle {
namespace {

using engine::Error;
using engine::ErrorCode;
using engine::Result;

constexpr double kPlaneEdge = 1000, kPlaneDepth = 10;

Eigen::Quaterniond rotation(const Turn& t) { return Eigen::Quaterniond(t[3], t[0], t[1], t[2]).normalized(); }

Double3 turnedBy(const Turn& turn, const Double3& v) {
    const Eigen::Vector3d r = rotation(turn) * Eigen::Vector3d(v[0], v[1], v[2]);
    return {r.x(), r.y(), r.z()};
}

// About `center`.
PieceShape pieceOf(const ConvexHull& hull, const Double3& center) {
    PieceShape piece;
    for (const Double3& v : hull.vertices)
        piece.vertices.push_back(toFloat(v - center));
    for (const ConvexHull::Face& face : hull.faces)
        piece.loops.emplace_back(hull.corners.begin() + face.first_corner,
                                 hull.corners.begin() + face.first_corner + face.corner_count);
    return piece;
}

// A piece of fracture's, whose vertices count from the middle of what was broken.
PieceShape pieceOf(const ColliderSet& set, const ColliderPiece& piece, const Double3& center, double grow) {
    PieceShape shape;
    for (uint32_t v = 0; v < piece.vertex_count; v++) {
        const Double3 from = toDouble(set.vertices[piece.first_vertex + v]) - center;
        const double length = std::sqrt(dot(from, from));
        shape.vertices.push_back(toFloat(length > 0 ? (1 + grow / length) * from : from));
    }
    for (uint32_t f = 0; f < piece.face_count; f++) {
        const ColliderFace& face = set.faces[piece.first_face + f];
        shape.loops.emplace_back(set.corners.begin() + face.first_corner,
                                 set.corners.begin() + face.first_corner + face.corner_count);
    }
    return shape;
}

BodyDefinition bodyOf(const BodyDescription& d) {
    BodyDefinition body;
    body.name = d.name;
    body.turn = d.turn;
    body.velocity = d.velocity;
    body.spin = d.spin;
    body.friction = d.surface.friction;
    body.restitution = d.surface.restitution;
    return body;
}

std::array<double, 6> scaled(std::array<double, 6> inertia, double density) {
    for (double& x : inertia)
        x *= density;
    return inertia;
}

Result<void> addWhole(WorldContents& contents, const BodyDescription& d, const std::filesystem::path& folder) {
    const auto hull = hullOf(d.shape, folder);
    if (!hull) return Error{hull.error().code, "body \"" + d.name + "\": " + hull.error().message};
    BodyDefinition body = bodyOf(d);
    body.pieces = {pieceOf(hull->hull, hull->measures.center)};
    body.place = d.place + turnedBy(d.turn, hull->measures.center);
    body.mass = massOf(d, hull->measures.volume);
    body.inertia = scaled(hull->measures.inertia, body.mass / hull->measures.volume);
    if (auto added = addBody(contents, body); !added) return added.error();
    return {};
}

ImportedMesh meshOf(const ConvexHull& hull) {
    ImportedMesh mesh;
    mesh.positions = hull.vertices;
    for (const ConvexHull::Face& face : hull.faces)
        for (uint32_t k = 2; k < face.corner_count; k++) {
            const uint32_t* corner = &hull.corners[face.first_corner];
            mesh.triangles.push_back({corner[0], corner[k - 1], corner[k]});
        }
    mesh.corner_normals.resize(3 * mesh.triangles.size(), {0, 0, 0});
    mesh.corner_uvs.resize(3 * mesh.triangles.size(), {0, 0});
    return mesh;
}

Result<ImportedMesh> modelOf(const ShapeDescription& shape, const std::filesystem::path& folder) {
    constexpr std::string_view kBuiltin = "builtin:";
    if (shape.kind != ShapeKind::Mesh) {
        const auto hull = hullOf(shape, folder);
        if (!hull) return hull.error();
        return meshOf(hull->hull);
    }
    const std::string_view file = shape.file;
    auto model = file.starts_with(kBuiltin) ? makeBuiltin(file.substr(kBuiltin.size())) : importMesh(folder / shape.file);
    if (!model) return model;
    for (Double3& p : model->positions)
        for (size_t k = 0; k < 3; k++)
            p[k] *= shape.scale[k];
    return model;
}

Result<FragmentSet> cellsOf(const ShapeDescription& shape, const std::filesystem::path& folder, Fracture& fracture) {
    auto model = modelOf(shape, folder);
    if (!model) return model.error();
    auto mesh = prepareMesh(*model);
    if (!mesh) return mesh.error();
    FractureOptions options;
    options.site_count = std::max(shape.cells.sites, 1u);
    options.seed = shape.cells.seed;
    options.pattern = shape.cells.pattern;
    options.impact = {shape.cells.at, contactRadiusOf(shape.cells.strength), favorOf(shape.cells.strength)};
    options.collider = shape.cells.directions;
    auto broken = fracture.shatter(mesh->mesh, mesh->topology, options);
    if (!broken) return broken.error();
    return std::move(broken->fragments);
}

double densityOf(const BodyDescription& d, const FragmentSet& set) {
    double volume = 0;
    for (const Fragment& f : set.fragments)
        volume += f.volume;
    return massOf(d, volume) / volume;
}

// Each cell a body: at rest against each other, they move as the whole did.
Result<void> addBroken(WorldContents& contents, const BodyDescription& d, const FragmentSet& set, double density) {
    for (uint32_t k = 0; k < set.fragments.size(); k++) {
        const Fragment& f = set.fragments[k];
        BodyDefinition body = bodyOf(d);
        body.name += "/" + std::to_string(k);
        const Double3 way = turnedBy(d.turn, set.center + f.centroid);
        body.pieces = {pieceOf(set.colliders, set.colliders.pieces[k], f.centroid, d.shape.cells.inflate)};
        body.place = d.place + way;
        body.velocity = d.velocity + cross(d.spin, way);
        body.mass = density * f.volume;
        body.inertia = scaled(f.inertia, density);
        if (auto added = addBody(contents, body); !added) return added.error();
    }
    return {};
}

// All of the cells together, about their common center of mass.
Result<void> addCompound(WorldContents& contents, const BodyDescription& d, const FragmentSet& set, double density) {
    Double3 center = {0, 0, 0};
    double mass = 0;
    for (const Fragment& f : set.fragments) {
        mass += density * f.volume;
        center = center + density * f.volume * f.centroid;
    }
    center = (1 / mass) * center;
    BodyDefinition body = bodyOf(d);
    body.mass = mass;
    for (uint32_t k = 0; k < set.fragments.size(); k++) {
        const Fragment& f = set.fragments[k];
        const Double3 r = f.centroid - center;
        const double m = density * f.volume, square = dot(r, r);
        const double away[6] = {square - r[0] * r[0], square - r[1] * r[1], square - r[2] * r[2],
                                -r[0] * r[1],         -r[0] * r[2],         -r[1] * r[2]};
        for (size_t i = 0; i < 6; i++)
            body.inertia[i] += density * f.inertia[i] + m * away[i];
        body.pieces.push_back(pieceOf(set.colliders, set.colliders.pieces[k], center, 0));
    }
    body.place = d.place + turnedBy(d.turn, set.center + center);
    if (auto added = addBody(contents, body); !added) return added.error();
    return {};
}

Result<void> addDescribed(WorldContents& contents, const BodyDescription& d, const std::filesystem::path& folder,
                          Fracture* fracture) {
    if (d.shape.cells.sites == 0 && d.shape.kind != ShapeKind::Mesh) return addWhole(contents, d, folder);
    if (fracture == nullptr)
        return Error{ErrorCode::Internal, "body \"" + d.name + "\" has cells, and there is nothing to cut them with"};
    const auto set = cellsOf(d.shape, folder, *fracture);
    if (!set) return Error{set.error().code, "body \"" + d.name + "\": " + set.error().message};
    const double density = densityOf(d, *set);
    return d.shape.cells.broken ? addBroken(contents, d, *set, density) : addCompound(contents, d, *set, density);
}

PieceShape planePiece() {
    const auto hull = hullOfPoints(std::vector<Double3>{{-kPlaneEdge / 2, 0, -kPlaneEdge / 2},
                                                        {kPlaneEdge / 2, 0, -kPlaneEdge / 2},
                                                        {-kPlaneEdge / 2, 0, kPlaneEdge / 2},
                                                        {kPlaneEdge / 2, 0, kPlaneEdge / 2},
                                                        {-kPlaneEdge / 2, -kPlaneDepth, -kPlaneEdge / 2},
                                                        {kPlaneEdge / 2, -kPlaneDepth, -kPlaneEdge / 2},
                                                        {-kPlaneEdge / 2, -kPlaneDepth, kPlaneEdge / 2},
                                                        {kPlaneEdge / 2, -kPlaneDepth, kPlaneEdge / 2}});
    return pieceOf(hull->hull, {0, 0, 0});
}

// Every triangle is a piece of its own, with two sides.
Result<std::vector<PieceShape>> surfacePieces(const ShapeDescription& shape, const std::filesystem::path& folder) {
    const auto model = modelOf(shape, folder);
    if (!model) return model.error();
    std::vector<PieceShape> pieces;
    for (const Index3& t : model->triangles) {
        PieceShape piece;
        for (const uint32_t v : t)
            piece.vertices.push_back(toFloat(model->positions[v]));
        piece.loops = {{0, 1, 2}, {2, 1, 0}};
        pieces.push_back(std::move(piece));
    }
    return pieces;
}

// A plane has no middle: its box lies below the bodies.
Double3 middleOf(const ColliderDescription& d, const std::vector<BodyDescription>& bodies) {
    if (bodies.empty()) return d.place;
    Double3 mean = {0, 0, 0};
    for (const BodyDescription& body : bodies)
        mean += (1.0 / static_cast<double>(bodies.size())) * body.place;
    const Double3 out = turnedBy(d.turn, {0, 1, 0});
    return mean - dot(mean - d.place, out) * out;
}

Result<void> addCollider(WorldContents& contents, const ColliderDescription& d, const SceneDescription& scene,
                         const std::filesystem::path& folder) {
    BodyDefinition body;
    body.name = d.name;
    body.place = d.place;
    body.turn = d.turn;
    body.friction = d.surface.friction;
    body.restitution = d.surface.restitution;
    if (d.shape.kind == ShapeKind::Plane) {
        body.pieces = {planePiece()};
        body.place = middleOf(d, scene.bodies);
    } else if (d.shape.kind == ShapeKind::Mesh) {
        auto pieces = surfacePieces(d.shape, folder);
        if (!pieces) return Error{pieces.error().code, "collider \"" + d.name + "\": " + pieces.error().message};
        body.pieces = std::move(*pieces);
    } else {
        const auto hull = hullOf(d.shape, folder);
        if (!hull) return Error{hull.error().code, "collider \"" + d.name + "\": " + hull.error().message};
        body.pieces = {pieceOf(hull->hull, {0, 0, 0})};
    }
    if (auto added = addBody(contents, body); !added) return added.error();
    return {};
}

bool hasEffect(const SceneDescription& scene, std::string_view name) {
    return std::ranges::find(scene.effects, name) != scene.effects.end();
}

} // namespace

Result<WorldContents> contentsOf(const SceneDescription& scene, const std::filesystem::path& folder, Fracture* fracture) {
    WorldContents contents;
    for (const BodyDescription& body : scene.bodies)
        if (auto added = addDescribed(contents, body, folder, fracture); !added) return added.error();
    for (const ColliderDescription& collider : scene.colliders)
        if (auto added = addCollider(contents, collider, scene, folder); !added) return added.error();
    if (!hasEffect(scene, "friction"))
        for (gpu::BodyShape& shape : contents.shapes)
            shape.inverse_inertia[0].w = 0;
    if (!hasEffect(scene, "restitution"))
        for (gpu::BodyShape& shape : contents.shapes)
            shape.inverse_inertia[1].w = 0;
    return contents;
}

Result<StepSettings> settingsOf(const SceneDescription& scene) {
    StepSettings s;
    s.gravity = hasEffect(scene, "gravity") ? scene.gravity : Double3{0, 0, 0};
    s.dt = scene.step.dt;
    s.substeps = scene.step.substeps;
    s.contact_hertz = scene.step.contact_hertz;
    s.contact_damping = scene.step.contact_damping;
    s.push_out = scene.step.push_out;
    s.margin = scene.step.margin;
    s.recycling = scene.step.recycling;
    s.fixed_axes = scene.step.axes == AxisKind::Fixed ? 26 : 0;
    if (scene.step.solver == SolverKind::Hard)
        return Error{ErrorCode::BadInput, "the scene asks for the hard solver, which there is not yet; leave step.solver out"};
    return s;
}

} // namespace brittle
