#include "tests/reference/predicates.h"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <vector>

namespace reference {
namespace {

// A weight for every site: 1 for the one with this id, 0 for all others.
using UnitWeight = std::optional<uint32_t>;
using Row = std::array<BigInt, 3>;

int64_t weightOf(uint32_t id, UnitWeight unit) { return unit == id ? 1 : 0; }

// The sign of a function that is linear in the weights. 0 only where all its coefficients vanish.
int signUnderWeights(std::vector<uint32_t> ids, const std::function<BigInt(UnitWeight)>& value) {
    const BigInt plain = value(std::nullopt);
    if (plain.sign() != 0) return plain.sign();
    std::sort(ids.begin(), ids.end());
    for (const uint32_t id : ids)
        if (const int sign = value(id).sign(); sign != 0) return sign;
    return 0;
}

BigInt determinant(const Row& a, const Row& b, const Row& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

// Normal and offset of a plane in coordinates 2 (x - self): normal . x <= offset.
struct Plane {
    Row normal;
    BigInt offset;
};

Plane bisectorOf(const Site& self, const Site& other, UnitWeight unit) {
    Plane plane;
    for (size_t k = 0; k < 3; ++k) {
        const int64_t d = int64_t{other.at[k]} - self.at[k];
        plane.normal[k] = BigInt(d);
        plane.offset = plane.offset + BigInt(d) * BigInt(d);
    }
    plane.offset = plane.offset + BigInt(weightOf(self.id, unit) - weightOf(other.id, unit));
    return plane;
}

Plane planeOf(const Site& self, const CellPlane& plane, UnitWeight unit) {
    if (plane.kind == CellPlane::Kind::Bisector) return bisectorOf(self, plane.site, unit);
    const int64_t direction = plane.kind == CellPlane::Kind::UpperWall ? 1 : -1;
    Plane wall;
    wall.normal[plane.axis] = BigInt(direction);
    wall.offset = BigInt(2 * direction * (int64_t{plane.coordinate} - self.at[plane.axis]));
    return wall;
}

// How far the corner of three planes lies beyond a fourth, times the turn of the three: a determinant of four rows, expanded
// by its last column.
BigInt excess(const std::array<Plane, 3>& p, const Plane& cutter) {
    return p[0].offset * determinant(cutter.normal, p[1].normal, p[2].normal) +
           p[1].offset * determinant(p[0].normal, cutter.normal, p[2].normal) +
           p[2].offset * determinant(p[0].normal, p[1].normal, cutter.normal) -
           cutter.offset * determinant(p[0].normal, p[1].normal, p[2].normal);
}

BigInt weighted(const Site& self, const Site& other, const GridPoint& p, UnitWeight unit) {
    return BigInt(nearness(self.at, other.at, p) + weightOf(self.id, unit) - weightOf(other.id, unit));
}

// Values of a line's function at the three corners; the line is where it is 0.
Row lineRow(const Site& self, const TriangleLine& line, const std::array<GridPoint, 3>& triangle, UnitWeight unit) {
    Row row;
    for (size_t k = 0; k < 3; ++k)
        row[k] = line.edge ? BigInt((*line.edge + 2) % 3 == k ? 1 : 0) : weighted(self, line.site, triangle[k], unit);
    return row;
}

} // namespace

int64_t nearness(const GridPoint& self, const GridPoint& site, const GridPoint& p) {
    int64_t sum = 0;
    for (size_t k = 0; k < 3; ++k) {
        const int64_t to_site = int64_t{p[k]} - site[k], to_self = int64_t{p[k]} - self[k];
        sum += to_site * to_site - to_self * to_self;
    }
    return sum;
}

int planesTurn(const Site& self, const std::array<CellPlane, 3>& planes) {
    return determinant(planeOf(self, planes[0], {}).normal, planeOf(self, planes[1], {}).normal,
                       planeOf(self, planes[2], {}).normal)
        .sign();
}

bool cutsCorner(const Site& self, const std::array<CellPlane, 3>& planes, const Site& cutter) {
    std::vector<uint32_t> ids = {self.id, cutter.id};
    for (const CellPlane& plane : planes)
        if (plane.kind == CellPlane::Kind::Bisector) ids.push_back(plane.site.id);
    const int sign = signUnderWeights(ids, [&](UnitWeight unit) {
        return excess({planeOf(self, planes[0], unit), planeOf(self, planes[1], unit), planeOf(self, planes[2], unit)},
                      bisectorOf(self, cutter, unit));
    });
    return sign * planesTurn(self, planes) > 0;
}

// The place is (Ja b - Jb a) / (Ja - Jb), and l's function is affine along the segment.
std::optional<int> edgeSign(const Site& self, const Site& j, const Site& l, const GridPoint& a, const GridPoint& b) {
    const int slope = (weighted(self, j, a, {}) - weighted(self, j, b, {})).sign();
    if (slope == 0) return std::nullopt;
    return slope * signUnderWeights({self.id, j.id, l.id}, [&](UnitWeight unit) {
               return weighted(self, j, a, unit) * weighted(self, l, b, unit) -
                      weighted(self, j, b, unit) * weighted(self, l, a, unit);
           });
}

std::optional<int> triangleSign(const Site& self, const std::array<TriangleLine, 2>& lines, const Site& l,
                                const std::array<GridPoint, 3>& triangle) {
    const Row ones = {1, 1, 1};
    const Row first = lineRow(self, lines[0], triangle, {}), second = lineRow(self, lines[1], triangle, {});
    const int crossing = determinant(first, second, ones).sign();
    if (crossing == 0) return std::nullopt;
    std::vector<uint32_t> ids = {self.id, l.id};
    for (const TriangleLine& line : lines)
        if (!line.edge) ids.push_back(line.site.id);
    return crossing * signUnderWeights(ids, [&](UnitWeight unit) {
               return determinant(lineRow(self, lines[0], triangle, unit), lineRow(self, lines[1], triangle, unit),
                                  lineRow(self, {std::nullopt, l}, triangle, unit));
           });
}

} // namespace reference
