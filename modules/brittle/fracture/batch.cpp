#include "modules/brittle/fracture/batch.h"

#include "modules/brittle/fracture/readback.h"
#include "modules/brittle/fracture/wedges.h"
#include "modules/brittle/mesh/vector_math.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace brittle {
namespace {

using engine::Error;
using engine::ErrorCode;
using engine::Result;

int32_t tileShift(uint32_t number) { return static_cast<int32_t>(number) << TILE_BITS; }
Int3 tileCorner(uint32_t number) { return {tileShift(number % TILES_IN_ROW), tileShift(number / TILES_IN_ROW), 0}; }

Error aboutObject(size_t object, const Error& error) {
    return {error.code, "object " + std::to_string(object + 1) + ": " + error.message};
}

void addSites(Batch& batch, const EventGrid& grid, std::span<const Double3> local_sites, uint32_t number) {
    const Int3 corner = tileCorner(number);
    for (const Double3& site : local_sites) {
        Int3 place = snapToGrid(grid, site);
        for (size_t k = 0; k < 3; ++k)
            place[k] += corner[k];
        batch.sites.push_back(place);
    }
}

void addVertices(Batch& batch, const Mesh& mesh, float factor, uint32_t number) {
    for (const Float3& p : mesh.positions)
        batch.mesh.positions.push_back({p[0] * factor, p[1] * factor, p[2] * factor});
    batch.vertex_tiles.resize(batch.mesh.positions.size(), number);
}

// Where an object's vertices and edges begin in the whole.
struct Bases {
    uint32_t vertex = 0, edge = 0;
};

void addTriangle(Batch& batch, const BreakingObject& object, uint32_t t, const Bases& bases) {
    const Index3 &corners = object.mesh.triangles[t], &edges = object.topology.triangle_edges[t];
    batch.mesh.triangles.push_back({corners[0] + bases.vertex, corners[1] + bases.vertex, corners[2] + bases.vertex});
    batch.topology.triangle_edges.push_back({edges[0] + bases.edge, edges[1] + bases.edge, edges[2] + bases.edge});
    for (size_t c = 3 * size_t{t}; c < 3 * size_t{t} + 3; ++c) {
        batch.mesh.corner_normals.push_back(object.mesh.corner_normals[c]);
        batch.mesh.corner_uvs.push_back(object.mesh.corner_uvs[c]);
    }
}

uint32_t ownTriangles(const Mesh& mesh) { return std::min(mesh.own_triangles, static_cast<uint32_t>(mesh.triangles.size())); }

// All objects' own surfaces, then all faces of earlier cuts, as in a mesh of one.
void addTriangles(Batch& batch, std::span<const BreakingObject> objects, const std::vector<Bases>& bases) {
    for (size_t k = 0; k < objects.size(); ++k)
        for (uint32_t t = 0; t < ownTriangles(objects[k].mesh); ++t)
            addTriangle(batch, objects[k], t, bases[k]);
    batch.mesh.own_triangles = static_cast<uint32_t>(batch.mesh.triangles.size());
    for (size_t k = 0; k < objects.size(); ++k)
        for (auto t = ownTriangles(objects[k].mesh); t < objects[k].mesh.triangles.size(); ++t)
            addTriangle(batch, objects[k], t, bases[k]);
}

void addEdges(Batch& batch, const MeshTopology& topology, uint32_t first_vertex) {
    for (const auto& edge : topology.edges)
        batch.topology.edges.push_back({edge[0] + first_vertex, edge[1] + first_vertex});
}

Result<void> addObject(Batch& batch, const BreakingObject& object, std::vector<Bases>& bases) {
    const auto number = static_cast<uint32_t>(batch.objects.size());
    if (object.sites.empty()) return Error{ErrorCode::BadInput, "has no sites; give it at least one"};
    if (object.mesh.triangles.empty()) return Error{ErrorCode::BadInput, "has no triangles"};
    std::vector<Double3> local_sites;
    for (const Double3& site : object.sites)
        local_sites.push_back(site - object.mesh.center);
    const auto count = static_cast<uint32_t>(local_sites.size());
    const auto grid = makeEventGrid(object.mesh, local_sites, count);
    if (!grid) return grid.error();
    batch.objects.push_back(
        {object.mesh.center, double{kTileScale} / double{grid->scale}, static_cast<uint32_t>(batch.sites.size()), count});
    bases.push_back({static_cast<uint32_t>(batch.mesh.positions.size()), static_cast<uint32_t>(batch.topology.edges.size())});
    addEdges(batch, object.topology, bases.back().vertex);
    addVertices(batch, object.mesh, grid->scale / kTileScale, number);
    addSites(batch, *grid, local_sites, number);
    batch.capacity.add(estimateCapacities(object.mesh, object.topology, *grid, count));
    batch.capacity.touching = batch.capacity.touching || mayTouchOnGrid(object.mesh, object.topology, *grid);
    return {};
}

uint32_t mostSites(const Batch& batch) { return std::ranges::max(batch.objects, {}, &Batch::Object::site_count).site_count; }

} // namespace

Result<Batch> joinObjects(std::span<const BreakingObject> objects) {
    if (objects.empty() || objects.size() > kMostObjects)
        return Error{ErrorCode::BadInput, std::to_string(objects.size()) + " objects are to break at once; give 1 to " +
                                              std::to_string(kMostObjects)};
    Batch batch;
    std::vector<Bases> bases;
    for (size_t k = 0; k < objects.size(); ++k)
        if (auto added = addObject(batch, objects[k], bases); !added) return aboutObject(k, added.error());
    addTriangles(batch, objects, bases);
    batch.grid = gridOfTiles(static_cast<uint32_t>(objects.size()), mostSites(batch));
    batch.capacity.bins = batch.grid.binCount();
    batch.capacity.tiled = true;
    return batch;
}

namespace {

// A result while fragments are sorted out to it.
class Part {
public:
    Part(const Batch::Object& object, const FractureResult& all) : object_(object), all_(all) {
        result_.fragments.center = object.center;
    }

    void addSite(const Double3& site) { result_.sites.push_back(inModel(site)); }
    void addFragment(const Fragment& from, uint32_t first_cell) {
        Fragment f = from;
        const double u = object_.unit;
        f.cell -= first_cell;
        f.site = result_.sites[f.cell];
        f.volume *= u * u * u;
        for (double& moment : f.inertia)
            moment *= u * u * u * u * u;
        f.centroid = u * f.centroid;
        for (size_t k = 0; k < 3; ++k) {
            f.lower[k] *= static_cast<float>(u);
            f.upper[k] *= static_cast<float>(u);
        }
        takeCorners(from, f);
        result_.fragments.fragments.push_back(f);
    }
    void addPiece(const ColliderPiece& from, uint32_t first_cell) {
        ColliderSet& set = result_.fragments.colliders;
        const ColliderSet& whole = all_.fragments.colliders;
        ColliderPiece piece = from;
        piece.cell -= first_cell;
        piece.first_face = static_cast<uint32_t>(set.faces.size());
        piece.first_vertex = static_cast<uint32_t>(set.vertices.size());
        piece.first_corner = static_cast<uint32_t>(set.corners.size());
        for (uint32_t k = 0; k < from.face_count; ++k)
            set.faces.push_back(faceOf(whole.faces[from.first_face + k], from, piece, first_cell));
        for (uint32_t k = 0; k < from.vertex_count; ++k)
            set.vertices.push_back(scaled(whole.vertices[from.first_vertex + k]));
        for (uint32_t k = 0; k < from.corner_count; ++k)
            set.corners.push_back(whole.corners[from.first_corner + k]);
        set.pieces.push_back(piece);
    }
    FractureResult& result() { return result_; }

private:
    Double3 inModel(const Double3& p) const { return object_.center + object_.unit * p; }
    Float3 scaled(const Float3& p) const {
        const auto u = static_cast<float>(object_.unit);
        return {p[0] * u, p[1] * u, p[2] * u};
    }
    void takeCorners(const Fragment& from, Fragment& to) {
        FragmentSet& set = result_.fragments;
        to.first_vertex = static_cast<uint32_t>(set.vertices.size());
        to.first_index = static_cast<uint32_t>(set.indices.size());
        for (uint32_t k = 0; k < from.vertex_count; ++k) {
            FragmentVertex v = all_.fragments.vertices[from.first_vertex + k];
            for (float& x : v.position)
                x *= static_cast<float>(object_.unit);
            set.vertices.push_back(v);
        }
        for (uint32_t k = 0; k < from.outer_index_count + from.inner_index_count; ++k)
            set.indices.push_back(all_.fragments.indices[from.first_index + k]);
    }
    ColliderFace faceOf(const ColliderFace& from, const ColliderPiece& was, const ColliderPiece& now,
                        uint32_t first_cell) const {
        ColliderFace face = from;
        face.height *= static_cast<float>(object_.unit);
        face.first_corner = from.first_corner - was.first_corner + now.first_corner;
        if (from.neighbor < BOX_BASE) face.neighbor = from.neighbor - first_cell;
        return face;
    }

    const Batch::Object& object_;
    const FractureResult& all_;
    FractureResult result_;
};

void countCells(FractureResult& result, uint32_t sites_requested) {
    FractureCounts& c = result.counts;
    c.sites_requested = sites_requested;
    c.sites_used = c.exact_total = static_cast<uint32_t>(result.sites.size());
    c.sites_welded = sites_requested - c.sites_used;
    countFilledCells(result);
}

} // namespace

std::vector<FractureResult> partResult(const Batch& batch, const FractureResult& all,
                                       const std::vector<uint32_t>& site_objects) {
    std::vector<Part> parts;
    for (const Batch::Object& object : batch.objects)
        parts.emplace_back(object, all);
    std::vector<uint32_t> first_cell(parts.size(), NO_INDEX), of_fragment;
    for (uint32_t s = 0; s < site_objects.size(); ++s) {
        first_cell[site_objects[s]] = std::min(first_cell[site_objects[s]], s);
        parts[site_objects[s]].addSite(all.sites[s]);
    }
    const FragmentSet& set = all.fragments;
    for (size_t f = 0; f < set.fragments.size(); ++f) {
        const uint32_t object = site_objects[set.fragments[f].cell];
        of_fragment.push_back(static_cast<uint32_t>(parts[object].result().fragments.fragments.size()));
        parts[object].addFragment(set.fragments[f], first_cell[object]);
        if (f < set.colliders.pieces.size()) parts[object].addPiece(set.colliders.pieces[f], first_cell[object]);
    }
    for (const auto& [a, b] : set.colliders.overlapping)
        parts[site_objects[set.fragments[a].cell]].result().fragments.colliders.overlapping.push_back(
            {of_fragment[a], of_fragment[b]});
    std::vector<FractureResult> results;
    for (size_t k = 0; k < parts.size(); ++k) {
        results.push_back(std::move(parts[k].result()));
        countCells(results[k], batch.objects[k].site_count);
    }
    results[0].timings = all.timings;
    results[0].total_ms = all.total_ms;
    results[0].setup_ms = all.setup_ms;
    return results;
}

} // namespace brittle
