#include "modules/brittle/collision/collider_mesh.h"

#include "modules/brittle/mesh/vector_math.h"

namespace brittle {
namespace {

void addVertex(FragmentSet& meshes, const Float3& p, const Float3& normal) {
    meshes.indices.push_back(static_cast<uint32_t>(meshes.vertices.size()));
    meshes.vertices.push_back({{p[0], p[1], p[2]}, {normal[0], normal[1], normal[2]}, {0, 0}});
}

void addFaces(const ColliderSet& colliders, const ColliderPiece& piece, bool of_cell, FragmentSet& meshes) {
    for (uint32_t k = 0; k < piece.face_count; ++k) {
        const ColliderFace& face = colliders.faces[piece.first_face + k];
        if ((face.kind == ColliderFaceKind::OfCell) != of_cell) continue;
        const uint32_t* loop = colliders.corners.data() + face.first_corner;
        for (uint32_t c = 1; c + 1 < face.corner_count; ++c)
            for (const uint32_t v : {loop[0], loop[c], loop[c + 1]})
                addVertex(meshes, colliders.vertices[piece.first_vertex + v], face.normal);
    }
}

void setBounds(const ColliderSet& colliders, const ColliderPiece& piece, Fragment& mesh) {
    Box box;
    for (uint32_t k = 0; k < piece.vertex_count; ++k)
        box.grow(toDouble(colliders.vertices[piece.first_vertex + k]));
    mesh.lower = toFloat(box.lower);
    mesh.upper = toFloat(box.upper);
}

} // namespace

FragmentSet meshesOfColliders(const FragmentSet& set) {
    FragmentSet meshes;
    meshes.center = set.center;
    for (size_t f = 0; f < set.colliders.pieces.size(); ++f) {
        const ColliderPiece& piece = set.colliders.pieces[f];
        const auto first = static_cast<uint32_t>(meshes.indices.size());
        addFaces(set.colliders, piece, false, meshes);
        const auto outer = static_cast<uint32_t>(meshes.indices.size()) - first;
        addFaces(set.colliders, piece, true, meshes);
        Fragment mesh;
        mesh.cell = piece.cell;
        mesh.first_index = first; // indices count from the set's first vertex
        mesh.vertex_count = static_cast<uint32_t>(meshes.indices.size()) - first;
        mesh.outer_index_count = outer;
        mesh.inner_index_count = mesh.vertex_count - outer;
        mesh.site = set.fragments[f].site;
        mesh.centroid = set.fragments[f].centroid;
        mesh.volume = volumeOf(set.colliders, piece);
        setBounds(set.colliders, piece, mesh);
        meshes.fragments.push_back(mesh);
    }
    return meshes;
}

} // namespace brittle
