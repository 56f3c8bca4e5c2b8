#include "tests/reference/voronoi.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

namespace reference {
namespace {

__extension__ using Wide = __int128;
using Vector = std::array<int64_t, 3>;
using WideVector = std::array<Wide, 3>;

// normal . w <= offset, in coordinates twice as fine as the grid and relative to the site.
struct HalfSpace {
    Vector normal;
    int64_t offset;
    uint32_t id;
};

struct Corner {
    std::array<uint32_t, 3> planes; // indices into Polyhedron::planes_, ascending
    WideVector numerator;
    Wide denominator; // > 0
    bool cut = false;
};

struct Side {
    uint32_t plane;  // across the edge
    uint32_t corner; // at the end of the edge, counter-clockwise
};

struct Face {
    uint32_t plane;
    std::vector<Side> sides;
};

Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class Scalar>
Wide dot(const Vector& a, const std::array<Scalar, 3>& b) {
    return Wide(a[0]) * b[0] + Wide(a[1]) * b[1] + Wide(a[2]) * b[2];
}

Wide determinant(const Vector& a, const Vector& b, const Vector& c) { return dot(a, cross(b, c)); }

HalfSpace boxPlane(const SiteSet& set, uint32_t site, uint32_t direction) {
    const uint32_t axis = direction / 2;
    const bool upper = direction % 2 == 1;
    const int64_t here = set.sites[site][axis];
    HalfSpace plane{{0, 0, 0}, 0, static_cast<uint32_t>(set.sites.size()) + direction};
    plane.normal[axis] = upper ? 1 : -1;
    plane.offset = 2 * (upper ? set.box.upper[axis] - here : here - set.box.lower[axis]);
    return plane;
}

HalfSpace bisector(const SiteSet& set, uint32_t site, uint32_t other) {
    HalfSpace plane{{0, 0, 0}, 0, other};
    for (size_t k = 0; k < 3; ++k) {
        plane.normal[k] = int64_t(set.sites[other][k]) - set.sites[site][k];
        plane.offset += plane.normal[k] * plane.normal[k];
    }
    return plane;
}

class Polyhedron {
public:
    Polyhedron(const SiteSet& set, uint32_t site);
    bool cut(const HalfSpace& plane); // false: it cut nothing
    double furthestCorner() const;    // squared distance from the site, in grid steps
    VoronoiCell finish() const;

private:
    uint32_t addCorner(uint32_t a, uint32_t b, uint32_t c);
    bool conflict(const Corner& corner, const HalfSpace& plane) const;
    bool tieConflict(const Corner& corner, const HalfSpace& plane) const;
    bool isSite(uint32_t id) const { return id < site_count_; }
    void cutFace(Face& face, uint32_t plane, std::map<uint32_t, Side>& rim);
    uint32_t newCorner(uint32_t a, uint32_t b, uint32_t cutter);
    void dropUnused();
    std::array<double, 3> position(const Corner& corner) const;

    uint32_t site_;
    uint32_t site_count_;
    std::vector<HalfSpace> planes_;
    std::vector<Corner> corners_;
    std::vector<Face> faces_;
    size_t first_new_corner_ = 0; // of the cut in progress
};

Polyhedron::Polyhedron(const SiteSet& set, uint32_t site) : site_(site), site_count_(static_cast<uint32_t>(set.sites.size())) {
    for (uint32_t direction = 0; direction < 6; ++direction)
        planes_.push_back(boxPlane(set, site, direction));
    uint32_t corner_of[2][2][2];
    for (uint32_t k = 0; k < 8; ++k)
        corner_of[k & 1][k >> 1 & 1][k >> 2] = addCorner(k & 1, 2 + (k >> 1 & 1), 4 + (k >> 2));
    for (uint32_t plane = 0; plane < 6; ++plane) {
        const uint32_t u = (plane / 2 + 1) % 3, v = (plane / 2 + 2) % 3, up = plane % 2;
        // Counter-clockwise around +axis: -v, +u, +v, -u; the other way around -axis.
        const std::array<uint32_t, 4> ring = {2 * v, 2 * u + up, 2 * v + 1, 2 * u + 1 - up};
        Face face{plane, {}};
        for (size_t k = 0; k < 4; ++k) {
            std::array<uint32_t, 3> end = {0, 0, 0};
            for (const uint32_t p : {plane, ring[k], ring[(k + 1) % 4]})
                end[p / 2] = p % 2;
            face.sides.push_back({ring[k], corner_of[end[0]][end[1]][end[2]]});
        }
        faces_.push_back(face);
    }
}

uint32_t Polyhedron::addCorner(uint32_t a, uint32_t b, uint32_t c) {
    Corner corner{{a, b, c}, {}, 0};
    std::sort(corner.planes.begin(), corner.planes.end());
    const HalfSpace& p = planes_[corner.planes[0]];
    const HalfSpace& q = planes_[corner.planes[1]];
    const HalfSpace& r = planes_[corner.planes[2]];
    const Vector qr = cross(q.normal, r.normal), rp = cross(r.normal, p.normal), pq = cross(p.normal, q.normal);
    const Wide det = dot(p.normal, qr);
    // Weights move planes but never turn them, so the planes of a corner always meet in one point.
    if (det == 0) throw std::logic_error("three planes of a corner do not meet in a point");
    for (size_t k = 0; k < 3; ++k) {
        const Wide value = Wide(p.offset) * qr[k] + Wide(q.offset) * rp[k] + Wide(r.offset) * pq[k];
        corner.numerator[k] = det > 0 ? value : -value;
    }
    corner.denominator = det > 0 ? det : -det;
    corners_.push_back(corner);
    return static_cast<uint32_t>(corners_.size() - 1);
}

bool Polyhedron::conflict(const Corner& corner, const HalfSpace& plane) const {
    const Wide excess = dot(plane.normal, corner.numerator) - Wide(plane.offset) * corner.denominator;
    return excess != 0 ? excess > 0 : tieConflict(corner, plane);
}

// The offset of every bisector is raised by w_self - w_other. The excess is linear in the offsets; the sign of a polynomial in
// eps that vanishes at 0 is the sign of its first coefficient, and the lowest id has the lowest power.
bool Polyhedron::tieConflict(const Corner& corner, const HalfSpace& plane) const {
    const std::array<const HalfSpace*, 4> planes = {&planes_[corner.planes[0]], &planes_[corner.planes[1]],
                                                    &planes_[corner.planes[2]], &plane};
    const Vector &a = planes[0]->normal, &b = planes[1]->normal, &c = planes[2]->normal, &e = plane.normal;
    const Wide det = determinant(a, b, c);
    const std::array<Wide, 4> by_offset = {determinant(e, b, c), determinant(a, e, c), determinant(a, b, e), -det};
    std::map<uint32_t, Wide> by_weight; // ascending ids
    for (size_t k = 0; k < 4; ++k) {
        if (!isSite(planes[k]->id)) continue;
        by_weight[site_] += by_offset[k];
        by_weight[planes[k]->id] -= by_offset[k];
    }
    for (const auto& [id, coefficient] : by_weight)
        if (coefficient != 0) return (coefficient > 0) == (det > 0);
    throw std::logic_error("a tie that no weight breaks: equal sites");
}

bool Polyhedron::cut(const HalfSpace& plane) {
    bool any = false;
    for (Corner& corner : corners_)
        any |= corner.cut = conflict(corner, plane);
    if (!any) return false;
    const uint32_t index = static_cast<uint32_t>(planes_.size());
    planes_.push_back(plane);
    first_new_corner_ = corners_.size();
    std::map<uint32_t, Side> rim; // by the face that the new face's edge lies on: the next side around the new face
    for (Face& face : faces_)
        cutFace(face, index, rim);
    std::erase_if(faces_, [](const Face& face) { return face.sides.empty(); });
    if (rim.size() < 3) throw std::logic_error("a cut that leaves no face: the cell is lost");

    Face cap{index, {}};
    uint32_t around = rim.begin()->first;
    for (size_t k = 0; k < rim.size(); ++k) {
        const Side& next = rim.at(around);
        cap.sides.push_back({around, next.corner});
        around = next.plane;
    }
    if (around != rim.begin()->first) throw std::logic_error("the rim of a cut is not one loop");
    faces_.push_back(cap);
    dropUnused();
    return true;
}

// The cut corners of a convex face are one run. Its last kept side before the run and the first after it are shortened, and the
// new plane becomes the side between them.
void Polyhedron::cutFace(Face& face, uint32_t plane, std::map<uint32_t, Side>& rim) {
    const size_t n = face.sides.size();
    const auto isCut = [&](size_t k) { return corners_[face.sides[k % n].corner].cut; };
    size_t enter = n, leave = n, runs = 0, cut_count = 0;
    for (size_t k = 0; k < n; ++k) {
        cut_count += isCut(k);
        if (!isCut(k + n - 1) && isCut(k)) enter = k, ++runs;
        if (isCut(k + n - 1) && !isCut(k)) leave = k;
    }
    if (cut_count == 0) return;
    if (cut_count == n) return face.sides.clear();
    if (runs != 1) throw std::logic_error("a plane cuts a convex face in more than one run");

    const auto cornerOn = [&](uint32_t side) { return newCorner(face.plane, side, plane); };
    std::vector<Side> kept;
    for (size_t k = leave; k % n != enter; ++k)
        kept.push_back(face.sides[k % n]);
    const uint32_t last = face.sides[enter].plane, first = face.sides[leave].plane;
    kept.push_back({last, cornerOn(last)});
    kept.push_back({plane, cornerOn(first)});
    rim[face.plane] = kept[kept.size() - 2];
    face.sides = std::move(kept);
}

// Each corner of the rim is met from two faces; the second finds what the first has made.
uint32_t Polyhedron::newCorner(uint32_t a, uint32_t b, uint32_t cutter) {
    std::array<uint32_t, 3> wanted = {a, b, cutter};
    std::sort(wanted.begin(), wanted.end());
    for (size_t k = first_new_corner_; k < corners_.size(); ++k)
        if (corners_[k].planes == wanted) return static_cast<uint32_t>(k);
    return addCorner(a, b, cutter);
}

void Polyhedron::dropUnused() {
    std::vector<Corner> kept;
    std::vector<uint32_t> moved(corners_.size());
    for (uint32_t k = 0; k < corners_.size(); ++k) {
        moved[k] = static_cast<uint32_t>(kept.size());
        if (!corners_[k].cut) kept.push_back(corners_[k]);
    }
    for (Face& face : faces_)
        for (Side& side : face.sides)
            side.corner = moved[side.corner];
    corners_ = std::move(kept);
}

std::array<double, 3> Polyhedron::position(const Corner& corner) const {
    const double scale = 2.0 * static_cast<double>(corner.denominator);
    return {static_cast<double>(corner.numerator[0]) / scale, static_cast<double>(corner.numerator[1]) / scale,
            static_cast<double>(corner.numerator[2]) / scale};
}

double Polyhedron::furthestCorner() const {
    double furthest = 0;
    for (const Corner& corner : corners_) {
        const std::array<double, 3> p = position(corner);
        furthest = std::max(furthest, p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    }
    return furthest;
}

VoronoiCell Polyhedron::finish() const {
    VoronoiCell cell;
    cell.site = site_;
    for (const Face& face : faces_) {
        CellFace out{planes_[face.plane].id, {}, {}};
        for (const Side& side : face.sides) {
            out.sides.push_back(planes_[side.plane].id);
            out.corners.push_back(position(corners_[side.corner]));
        }
        cell.neighbors.push_back(out.neighbor);
        cell.faces.push_back(std::move(out));
    }
    for (const Corner& corner : corners_) {
        VertexName name = {site_, 0, 0, 0};
        for (size_t k = 0; k < 3; ++k)
            name[k + 1] = planes_[corner.planes[k]].id;
        std::sort(name.begin(), name.end());
        cell.vertices.push_back(name);
    }
    std::sort(cell.neighbors.begin(), cell.neighbors.end());
    std::sort(cell.vertices.begin(), cell.vertices.end());
    std::sort(cell.faces.begin(), cell.faces.end(), [](const auto& a, const auto& b) { return a.neighbor < b.neighbor; });
    return cell;
}

} // namespace

VoronoiCell cutCell(const SiteSet& set, uint32_t site, Cutting cutting) {
    Polyhedron cell(set, site);
    std::vector<std::pair<int64_t, uint32_t>> others; // squared distance, id
    for (uint32_t k = 0; k < set.sites.size(); ++k)
        if (k != site) others.emplace_back(bisector(set, site, k).offset, k);
    if (cutting == Cutting::Everything) {
        for (const auto& [distance, other] : others)
            cell.cut(bisector(set, site, other));
        return cell.finish();
    }
    std::make_heap(others.begin(), others.end(), std::greater<>());
    double furthest = cell.furthestCorner();
    for (auto end = others.end(); end != others.begin(); --end) {
        std::pop_heap(others.begin(), end, std::greater<>());
        const auto [distance, other] = *(end - 1);
        if (static_cast<double>(distance) > 4.0 * furthest * (1.0 + 1e-6)) break;
        if (cell.cut(bisector(set, site, other))) furthest = cell.furthestCorner();
    }
    return cell.finish();
}

std::vector<VoronoiCell> cutAllCells(const SiteSet& set, Cutting cutting) {
    std::vector<VoronoiCell> cells;
    for (uint32_t site = 0; site < set.sites.size(); ++site)
        cells.push_back(cutCell(set, site, cutting));
    return cells;
}

double cellVolume(const VoronoiCell& cell) {
    double six_volumes = 0;
    for (const CellFace& face : cell.faces) {
        const auto& p = face.corners;
        for (size_t k = 1; k + 1 < p.size(); ++k)
            six_volumes += p[0][0] * (p[k][1] * p[k + 1][2] - p[k][2] * p[k + 1][1]) +
                           p[0][1] * (p[k][2] * p[k + 1][0] - p[k][0] * p[k + 1][2]) +
                           p[0][2] * (p[k][0] * p[k + 1][1] - p[k][1] * p[k + 1][0]);
    }
    return six_volumes / 6;
}

DiagramAudit auditDiagram(const std::vector<VoronoiCell>& cells) {
    DiagramAudit audit;
    const auto has = [](const auto& list, const auto& item) { return std::binary_search(list.begin(), list.end(), item); };
    for (const VoronoiCell& cell : cells) {
        if (cell.neighbors.size() < 4) ++audit.lost_cells;
        if (cell.neighbors.size() >= 4 && cell.vertices.size() != 2 * (cell.neighbors.size() - 2)) ++audit.broken_cells;
        for (const uint32_t other : cell.neighbors)
            if (other < cells.size() && !has(cells[other].neighbors, cell.site)) ++audit.one_sided_faces;
        for (const VertexName& name : cell.vertices) {
            bool agreed = has(name, cell.site);
            for (const uint32_t id : name)
                agreed &= id >= cells.size() || has(cells[id].vertices, name);
            if (!agreed) ++audit.disputed_vertices;
        }
    }
    return audit;
}

} // namespace reference
