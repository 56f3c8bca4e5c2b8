#include "modules/brittle/mesh/measures.h"

#include "modules/brittle/mesh/vector_math.h"

namespace brittle {

// Positions are relative to the box's center already, so no digits are lost to distance.
MeshMeasures measureMesh(const Mesh& mesh) {
    MeshMeasures measures;
    Box box;
    Double3 moment = {0, 0, 0};
    for (const Index3& t : mesh.triangles) {
        const Double3 a = toDouble(mesh.positions[t[0]]), b = toDouble(mesh.positions[t[1]]),
                      c = toDouble(mesh.positions[t[2]]);
        const double six_volumes = dot(a, cross(b, c));
        measures.volume += six_volumes / 6;
        measures.area += length(cross(b - a, c - a)) / 2;
        moment += six_volumes * (a + b + c);
        for (const Double3& corner : {a, b, c})
            box.grow(corner);
    }
    if (mesh.triangles.empty()) return measures;
    measures.diagonal = box.diagonal();
    if (measures.volume != 0) measures.centroid = (1 / (24 * measures.volume)) * moment;
    return measures;
}

} // namespace brittle
