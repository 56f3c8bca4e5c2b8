#include "tests/support/fragment_file.h"

#include "modules/brittle/mesh/vector_math.h"

namespace support {
namespace {

using reference::Triangle, reference::Triangles;
using reference::operator+;

reference::Piece pieceOf(const brittle::FragmentSet& set, const brittle::Fragment& fragment) {
    reference::Piece piece;
    piece.translation = set.center;
    piece.site = fragment.site;
    piece.cell = fragment.cell;
    piece.volume = fragment.volume;
    const uint32_t outer_end = fragment.first_index + fragment.outer_index_count;
    for (uint32_t i = fragment.first_index; i < outer_end + fragment.inner_index_count; i += 3) {
        Triangle triangle;
        for (uint32_t k = 0; k < 3; ++k)
            triangle[k] = positionOf(set.vertices[fragment.first_vertex + set.indices[i + k]]);
        (i < outer_end ? piece.outer : piece.inner).push_back(triangle);
    }
    return piece;
}

} // namespace

reference::FragmentFile fragmentFile(const brittle::FragmentSet& set) {
    reference::FragmentFile file;
    for (const brittle::Fragment& fragment : set.fragments)
        file.pieces.push_back(pieceOf(set, fragment));
    return file;
}

Triangles trianglesOf(const brittle::Mesh& mesh) {
    Triangles triangles;
    for (const brittle::Index3& t : mesh.triangles) {
        Triangle& triangle = triangles.emplace_back();
        for (size_t k = 0; k < 3; ++k)
            triangle[k] = mesh.center + brittle::toDouble(mesh.positions[t[k]]);
    }
    return triangles;
}

} // namespace support
