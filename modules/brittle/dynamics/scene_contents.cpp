#include "modules/brittle/dynamics/scene_contents.h"

#include "modules/brittle/breaking/breakable.h"
#include "modules/brittle/dynamics/grown_piece.h"
#include "modules/brittle/dynamics/piece_shape.h"
#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/dynamics/sibling_contacts.h"
#include "modules/brittle/dynamics/triangle_pieces.h"
#include "modules/brittle/mesh/check.h"
#include "modules/brittle/mesh/prepare.h"
#include "modules/brittle/scene/body_shape.h"
#include "modules/brittle/scene/scene_material.h"
#include "modules/brittle/scene/shape_model.h"

#include <algorithm>

namespace brittle {
namespace {

using engine::Error;
using engine::ErrorCode;
using engine::Result;

constexpr double kPlaneEdge = 1000, kLeastDepth = 10; // m, of the hull that is always below what a plane is held against
constexpr double kLeastShown = 10;                    // m, of a plane's edge
constexpr uint64_t kStrengthSeed = 1;

Result<PieceShape> cellPiece(const FragmentSet& set, uint32_t k, double inflate) {
    const ColliderPiece& piece = set.colliders.pieces[k];
    const Double3& center = set.fragments[k].centroid;
    if (inflate == 0) return pieceOf(set.colliders, piece, center);
    return grownPiece(set.colliders, piece, center, inflate);
}

std::string nameOf(const std::string& given, const char* what, size_t index) {
    return given.empty() ? what + std::string("_") + std::to_string(index) : given;
}

BodyDefinition bodyOf(const BodyDescription& d, const std::string& name) {
    BodyDefinition body;
    body.name = name;
    body.material = d.material;
    body.turn = d.turn;
    body.velocity = d.velocity;
    body.spin = d.spin;
    body.friction = d.surface.friction;
    body.restitution = d.surface.restitution;
    body.is_round = d.shape.kind == ShapeKind::Ball;
    return body;
}

std::array<double, 6> scaled(std::array<double, 6> inertia, double density) {
    for (double& x : inertia)
        x *= density;
    return inertia;
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
    if (shape.kind != ShapeKind::Mesh) {
        const auto hull = hullOf(shape, folder);
        if (!hull) return hull.error();
        ImportedMesh mesh = meshOf(hull->hull);
        mesh.notes = hull->reader_notes;
        return mesh;
    }
    return readModel(shape, folder);
}

struct Cells {
    PreparedMesh model; // what was broken
    FragmentSet fragments;
    std::vector<std::string> reader_notes;
};

Result<Cells> cellsOf(const ShapeDescription& shape, const std::filesystem::path& folder, Fracture& fracture) {
    auto model = modelOf(shape, folder);
    if (!model) return model.error();
    auto mesh = prepareMesh(*model);
    if (!mesh) return mesh.error();
    if (shape.kind == ShapeKind::Mesh)
        if (const auto sound = checkMesh(mesh->mesh, mesh->topology); !sound)
            return Error{sound.error().code, shape.file + ": " + sound.error().message};
    FractureOptions options;
    options.site_count = std::max(shape.cells.sites, 1u);
    options.seed = shape.cells.seed;
    options.pattern = shape.cells.pattern;
    options.impact = {shape.cells.at, contactRadiusOf(shape.cells.strength), favorOf(shape.cells.strength)};
    options.collider = shape.cells.directions;
    auto broken = fracture.shatter(mesh->mesh, mesh->topology, options);
    if (!broken) return broken.error();
    return Cells{std::move(*mesh), std::move(broken->fragments), std::move(model->notes)};
}

double volumeOf(const FragmentSet& set) {
    double volume = 0;
    for (const Fragment& f : set.fragments)
        volume += f.volume;
    return volume;
}

PieceShape planePiece(double depth) {
    std::vector<Double3> corners;
    for (const double y : {0.0, -depth})
        for (const double z : {-kPlaneEdge / 2, kPlaneEdge / 2})
            for (const double x : {-kPlaneEdge / 2, kPlaneEdge / 2})
                corners.push_back({x, y, z});
    const auto hull = hullOfPoints(corners);
    PieceShape piece = pieceOf(hull->hull, {0, 0, 0});
    piece.is_plane = true;
    return piece;
}

// Leaves out bodies that do not move.
double largestRadius(const WorldContents& contents) {
    double largest = 0;
    for (size_t k = 0; k < contents.bodies.size(); ++k)
        if (contents.bodies[k].offset.w > 0) largest = std::max(largest, double{contents.shapes[k].inverse_inertia[2].w});
    return largest;
}

// A few times as far as bodies reach at the beginning.
double shownEdge(const WorldContents& contents, const Double3& middle) {
    double reach = kLeastShown / 6;
    for (size_t k = 0; k < contents.bodies.size(); ++k)
        if (contents.bodies[k].offset.w > 0)
            reach = std::max(reach, length(poseOf(contents.bodies[k]).place - middle) +
                                        double{contents.shapes[k].inverse_inertia[2].w});
    return std::min(6 * reach, kPlaneEdge);
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

// About the common center of mass of all cells: pieces, mass, inertia.
BodyDefinition compoundOf(BodyDefinition body, const FragmentSet& set, double density, const Double3& center) {
    for (uint32_t k = 0; k < set.fragments.size(); k++) {
        const Fragment& f = set.fragments[k];
        const Double3 r = f.centroid - center;
        const double m = density * f.volume, square = dot(r, r);
        const double away[6] = {square - r[0] * r[0], square - r[1] * r[1], square - r[2] * r[2],
                                -r[0] * r[1],         -r[0] * r[2],         -r[1] * r[2]};
        for (size_t i = 0; i < 6; i++)
            body.inertia[i] += density * f.inertia[i] + m * away[i];
        body.mass += m;
        body.pieces.push_back(pieceOf(set.colliders, set.colliders.pieces[k], center));
    }
    return body;
}

Double3 centerOf(const FragmentSet& set) {
    Double3 center = {0, 0, 0};
    double volume = 0;
    for (const Fragment& f : set.fragments) {
        volume += f.volume;
        center += f.volume * f.centroid;
    }
    return (1 / volume) * center;
}

// Adds what a scene describes, body by body, to a world's contents, and to what it looks like where that is asked for.
class ContentsMaker {
public:
    ContentsMaker(const SceneDescription& scene, const std::filesystem::path& folder, Fracture* fracture,
                  WorldSurfaces* surfaces)
        : scene_(scene), folder_(folder), fracture_(fracture) {
        if (surfaces != nullptr) surfaces_.emplace(*surfaces);
        const auto effects = resolve(scene.effects);
        breaks_ = effects && effects->set.has(Effect::ImpactFracture);
    }
    // `broken`: the cells of the first body, where it has been broken already.
    Result<WorldContents> all(const FragmentSet* broken);

private:
    Result<void> addDescribed(const BodyDescription& d, const std::string& name);
    Result<void> addWhole(const BodyDescription& d, const std::string& name);
    Result<void> addBroken(const BodyDescription& d, const std::string& name, const FragmentSet& set, const Double3& center);
    void addSiblings(const BodyDescription& d, const FragmentSet& set, const Double3& center);
    Result<void> addCompound(const BodyDescription& d, const std::string& name, const Cells& cells);
    Result<void> addCollider(const ColliderDescription& d, const std::string& name);
    Result<void> addPlane(const ColliderDescription& d, BodyDefinition body);
    Result<void> addSurface(const ColliderDescription& d, BodyDefinition body);
    void keepNotes(const ShapeDescription& shape, const std::vector<std::string>& notes);
    // Of a body whose material is known.
    double weigh(const BodyDescription& d, double volume) const { return massOf(d, *densityOf(d, scene_.materials), volume); }
    // `surface` is only made where surfaces are asked for.
    template <class MakeSurface>
    Result<void> add(const BodyDefinition& body, MakeSurface&& surface, bool is_plane = false) {
        if (auto added = addBody(contents_, body); !added) return added.error();
        if (surfaces_) surfaces_->add(body, surface(), is_plane);
        return {};
    }
    // The same of a body that may break, of so many cubic meters.
    template <class MakeSurface>
    Result<void> add(const BodyDescription& d, BodyDefinition body, double volume, MakeSurface&& surface) {
        if (d.fixed) {
            body.mass = 0;
            body.inertia = {};
        }
        if (auto added = add(body, surface); !added || !breaks_ || d.material.empty()) return added;
        const auto material = materialOf(d.material, scene_.materials);
        if (!material) return material.error();
        const auto index = static_cast<uint32_t>(contents_.bodies.size() - 1);
        return makeBreakable(
            contents_, {index, surface(), body, *material, volume, kStrengthSeed, static_cast<uint32_t>(d.break_pattern)});
    }

    const SceneDescription& scene_;
    const std::filesystem::path& folder_;
    Fracture* fracture_;
    WorldContents contents_;
    std::optional<SurfaceCollector> surfaces_;
    bool breaks_ = false;
};

Result<WorldContents> ContentsMaker::all(const FragmentSet* broken) {
    for (size_t k = 0; k < scene_.bodies.size(); k++) {
        const BodyDescription& body = scene_.bodies[k];
        const std::string name = nameOf(body.name, "body", k);
        if (const auto density = densityOf(body, scene_.materials); !density)
            return Error{density.error().code, "body \"" + name + "\": " + density.error().message};
        const bool is_there = k == 0 && broken != nullptr;
        const auto added = is_there ? addBroken(body, name, *broken, {0, 0, 0}) : addDescribed(body, name);
        if (!added) return added.error();
    }
    for (size_t k = 0; k < scene_.colliders.size(); k++)
        if (auto added = addCollider(scene_.colliders[k], nameOf(scene_.colliders[k].name, "collider", k)); !added)
            return added.error();
    return std::move(contents_);
}

Result<void> ContentsMaker::addDescribed(const BodyDescription& d, const std::string& name) {
    if (d.shape.cells.sites == 0 && d.shape.kind != ShapeKind::Mesh) return addWhole(d, name);
    if (fracture_ == nullptr)
        return Error{ErrorCode::Internal, "body \"" + name + "\" has cells, and there is nothing to cut them with"};
    const auto cells = cellsOf(d.shape, folder_, *fracture_);
    if (!cells) return Error{cells.error().code, "body \"" + name + "\": " + cells.error().message};
    keepNotes(d.shape, cells->reader_notes);
    const FragmentSet& set = cells->fragments;
    return d.shape.cells.broken ? addBroken(d, name, set, set.center) : addCompound(d, name, *cells);
}

void ContentsMaker::keepNotes(const ShapeDescription& shape, const std::vector<std::string>& notes) {
    for (const std::string& note : notes) {
        const std::string text = shape.file + ": note: " + note;
        if (std::ranges::find(contents_.reader_notes, text) == contents_.reader_notes.end())
            contents_.reader_notes.push_back(text);
    }
}

Result<void> ContentsMaker::addWhole(const BodyDescription& d, const std::string& name) {
    const auto hull = hullOf(d.shape, folder_);
    if (!hull) return Error{hull.error().code, "body \"" + name + "\": " + hull.error().message};
    keepNotes(d.shape, hull->reader_notes);
    const HullMeasures& measures = hull->measures;
    BodyDefinition body = bodyOf(d, name);
    body.pieces = {pieceOf(hull->hull, measures.center)};
    body.place = d.place + turnedBy(d.turn, measures.center);
    body.mass = weigh(d, measures.volume);
    body.inertia = scaled(measures.inertia, body.mass / measures.volume);
    return add(d, body, measures.volume, [&] { return surfaceOf(hull->hull, measures.center); });
}

// Each cell a body: at rest against each other, they move as the whole did.
// `center`: of the set, in the body's frame.
Result<void> ContentsMaker::addBroken(const BodyDescription& d, const std::string& name, const FragmentSet& set,
                                      const Double3& center) {
    const double volume = volumeOf(set), density = weigh(d, volume) / volume;
    for (uint32_t k = 0; k < set.fragments.size(); k++) {
        const Fragment& f = set.fragments[k];
        BodyDefinition body = bodyOf(d, name + "/" + std::to_string(k));
        const Double3 way = turnedBy(d.turn, center + f.centroid);
        const auto piece = cellPiece(set, k, d.shape.cells.inflate);
        if (!piece) return Error{piece.error().code, "body \"" + body.name + "\": " + piece.error().message};
        body.pieces = {*piece};
        body.place = d.place + way;
        body.velocity = d.velocity + cross(d.spin, way);
        body.mass = density * f.volume;
        body.inertia = scaled(f.inertia, density);
        const auto surface = [&] { return surfaceOf(set, f, f.centroid); };
        if (auto added = add(d, body, f.volume, surface); !added) return added;
    }
    if (d.shape.cells.inflate == 0) addSiblings(d, set, center);
    return {};
}

void ContentsMaker::addSiblings(const BodyDescription& d, const FragmentSet& set, const Double3& center) {
    const auto first = static_cast<uint32_t>(contents_.pieces.size() - set.fragments.size()); // a fragment is a piece
    for (const SharedFace& face : sharedFaces(set)) {
        SiblingContact contact = {first + face.a, first + face.b, turnedBy(d.turn, face.normal), {}};
        for (const Double3& p : face.points)
            contact.points.push_back(d.place + turnedBy(d.turn, center + p));
        contents_.siblings.push_back(std::move(contact));
    }
}

Result<void> ContentsMaker::addCompound(const BodyDescription& d, const std::string& name, const Cells& cells) {
    const FragmentSet& set = cells.fragments;
    const Double3 center = centerOf(set);
    const double volume = volumeOf(set);
    BodyDefinition body = compoundOf(bodyOf(d, name), set, weigh(d, volume) / volume, center);
    body.place = d.place + turnedBy(d.turn, set.center + center);
    return add(d, body, volume, [&] { return surfaceOf(cells.model.mesh, center); });
}

Result<void> ContentsMaker::addCollider(const ColliderDescription& d, const std::string& name) {
    BodyDefinition body;
    body.name = name;
    body.place = d.place;
    body.turn = d.turn;
    body.friction = d.surface.friction;
    body.restitution = d.surface.restitution;
    body.is_round = d.shape.kind == ShapeKind::Ball;
    if (d.shape.kind == ShapeKind::Plane) return addPlane(d, std::move(body));
    if (d.shape.kind == ShapeKind::Mesh) return addSurface(d, std::move(body));
    const auto hull = hullOf(d.shape, folder_);
    if (!hull) return Error{hull.error().code, "collider \"" + name + "\": " + hull.error().message};
    keepNotes(d.shape, hull->reader_notes);
    body.pieces = {pieceOf(hull->hull, {0, 0, 0})};
    return add(body, [&] { return surfaceOf(hull->hull, {0, 0, 0}); });
}

Result<void> ContentsMaker::addPlane(const ColliderDescription& d, BodyDefinition body) {
    body.pieces = {planePiece(std::max(kLeastDepth, 2 * largestRadius(contents_)))}; // else a body might leave it below
    body.place = middleOf(d, scene_.bodies);
    return add(
        body, [&] { return squareSurface(shownEdge(contents_, body.place)); }, true);
}

Result<void> ContentsMaker::addSurface(const ColliderDescription& d, BodyDefinition body) {
    const auto model = modelOf(d.shape, folder_);
    if (!model) return Error{model.error().code, "collider \"" + body.name + "\": " + model.error().message};
    keepNotes(d.shape, model->notes);
    body.pieces = trianglePieces(*model);
    if (body.pieces.empty())
        return Error{ErrorCode::BadInput, "collider \"" + body.name + "\": no triangle of " +
                                              (d.shape.file.empty() ? "its mesh" : d.shape.file) + " has an area"};
    return add(body, [&] { return surfaceOf(*model); });
}

} // namespace

Result<std::unique_ptr<Fracture>> fractureFor(const SceneDescription& scene, engine::Device& device, uint32_t group_size) {
    const bool cuts = std::ranges::any_of(scene.bodies, [](const BodyDescription& body) {
        return body.shape.cells.sites != 0 || body.shape.kind == ShapeKind::Mesh;
    });
    if (!cuts) return std::unique_ptr<Fracture>();
    return Fracture::create(device, group_size);
}

Result<WorldContents> contentsOf(const SceneDescription& scene, const std::filesystem::path& folder, Fracture* fracture,
                                 WorldSurfaces* surfaces) {
    return ContentsMaker(scene, folder, fracture, surfaces).all(nullptr);
}

Result<WorldContents> contentsOfBroken(const SceneDescription& scene, const FragmentSet& fragments, WorldSurfaces* surfaces) {
    return ContentsMaker(scene, {}, nullptr, surfaces).all(&fragments);
}

} // namespace brittle
