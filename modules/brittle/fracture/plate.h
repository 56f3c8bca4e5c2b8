// A mesh that is thin and flat, seen along its normal.
#pragma once

#include "modules/brittle/mesh/mesh.h"
#include "modules/brittle/mesh/vector_math.h"

#include <array>
#include <cstdint>
#include <vector>

namespace brittle {

// Box edges of the solid that has the mesh's volume and moments, and the axes of these; sorted, the thinnest first.
struct PrincipalBox {
    Double3 edges = {0, 0, 0};
    std::array<Double3, 3> axes;
};
PrincipalBox principalBoxOf(const Mesh& mesh);

constexpr double kFlat = 3; // times as wide as thick, both ways

// Places in the plane through its center of mass, which is (0, 0), and along the normal.
class Plate {
public:
    Plate(const Mesh& mesh, const Double3& normal);
    std::array<double, 2> onPlane(const Double3& local) const; // local: from the mesh's center
    Double3 fromPlane(const std::array<double, 2>& p) const;
    // Whether the line along the normal goes through the solid there.
    bool isInside(const std::array<double, 2>& p) const;
    // From the place to the rim, on the average of all directions: the integral of 1/r over the plate, over 2 pi.
    double reachFrom(const std::array<double, 2>& p) const;
    double furthestFrom(const std::array<double, 2>& p) const;
    double area() const { return area_; }

private:
    using Place = std::array<double, 2>;
    void fillBins();
    size_t binOf(double x, size_t axis) const;

    Double3 center_, across_, along_;
    std::vector<Place> places_;  // of the mesh's vertices
    std::vector<Index3> facing_; // triangles that face along the normal
    std::vector<std::vector<uint32_t>> bins_;
    Place low_ = {1e300, 1e300}, high_ = {-1e300, -1e300};
    size_t per_axis_ = 1;
    double area_ = 0;
};

} // namespace brittle
