#include "tests/reference/clipped_cells.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace reference {
namespace {

struct Plane {
    Point normal;
    double height;
    double beyond(const Point& p) const { return dot(normal, p) - height; }
};

Point onPlane(const Plane& plane, const Point& a, const Point& b) {
    const double from = plane.beyond(a), to = plane.beyond(b);
    return a + (from / (from - to)) * (b - a);
}

// What is left of the loop (Sutherland and Hodgman 1974); where it crosses the plane is added to `rim`.
std::vector<Point> clipped(const std::vector<Point>& loop, const Plane& plane, std::vector<Point>& rim) {
    std::vector<Point> kept;
    for (size_t k = 0; k < loop.size(); ++k) {
        const Point &a = loop[k], &b = loop[(k + 1) % loop.size()];
        const bool a_in = plane.beyond(a) <= 0, b_in = plane.beyond(b) <= 0;
        if (a_in) kept.push_back(a);
        if (a_in == b_in) continue;
        // From the same end whichever way the edge is walked, so that both faces have the same point.
        const Point crossing = a < b ? onPlane(plane, a, b) : onPlane(plane, b, a);
        kept.push_back(crossing);
        rim.push_back(crossing);
    }
    return kept;
}

// Of points on the rim of a convex face, around it, counter-clockwise about the normal.
std::vector<Point> loopAround(std::vector<Point> rim, const Point& normal) {
    Point center = {0, 0, 0};
    for (const Point& p : rim)
        center = center + (1.0 / static_cast<double>(rim.size())) * p;
    const size_t flat = static_cast<size_t>(
        std::min_element(normal.begin(), normal.end(), [](double a, double b) { return std::fabs(a) < std::fabs(b); }) -
        normal.begin());
    Point axis = {0, 0, 0};
    axis[flat] = 1;
    const Point u = cross(normal, axis), v = cross(normal, u);
    const auto angle = [&](const Point& p) { return std::atan2(dot(v, p - center), dot(u, p - center)); };
    std::sort(rim.begin(), rim.end(), [&](const Point& a, const Point& b) { return angle(a) < angle(b); });
    return rim;
}

Point faceVector(const PolyhedronFace& face) {
    Point sum = {0, 0, 0};
    for (size_t k = 2; k < face.loop.size(); ++k)
        sum = sum + cross(face.loop[k - 1] - face.loop[0], face.loop[k] - face.loop[0]);
    return 0.5 * sum;
}

double furthestFrom(const Point& p, const Polyhedron& solid) {
    double furthest = 0;
    for (const PolyhedronFace& face : solid.faces)
        for (const Point& q : face.loop)
            furthest = std::max(furthest, length(q - p));
    return furthest;
}

Polyhedron cellOf(std::span<const Point> sites, uint32_t own, const Bounds& box) {
    const Point& site = sites[own];
    std::vector<std::pair<double, uint32_t>> others;
    for (uint32_t k = 0; k < sites.size(); ++k)
        if (k != own) others.emplace_back(length(sites[k] - site), k);
    std::sort(others.begin(), others.end());
    Polyhedron cell = boxOf(box);
    // What is further than twice the furthest corner cuts nothing; a little more, for rounding.
    for (const auto& [distance, k] : others) {
        if (distance > 2.000001 * furthestFrom(site, cell)) break;
        const Point way = (1 / distance) * (sites[k] - site);
        cut(cell, way, dot(way, site) + distance / 2, k);
    }
    return cell;
}

std::vector<Plane> planesOf(const Polyhedron& solid) {
    std::vector<Plane> planes;
    for (const PolyhedronFace& face : solid.faces) {
        const Point normal = faceVector(face);
        const double size = length(normal);
        if (size > 0) planes.push_back({(1 / size) * normal, dot((1 / size) * normal, face.loop[0])});
    }
    return planes;
}

// The first three are counter-clockwise seen from outside.
Polyhedron tetrahedron(const std::array<Point, 4>& p) {
    return {{{0, {p[0], p[1], p[2]}}, {1, {p[1], p[0], p[3]}}, {2, {p[2], p[1], p[3]}}, {3, {p[0], p[2], p[3]}}}};
}

double volumeWithin(const std::array<Point, 4>& corners, const std::vector<Plane>& cell) {
    bool is_within = true;
    for (const Plane& plane : cell) {
        const auto out = std::count_if(corners.begin(), corners.end(), [&](const Point& p) { return plane.beyond(p) > 0; });
        if (out == 4) return 0;
        is_within = is_within && out == 0;
    }
    Polyhedron part = tetrahedron(corners);
    if (!is_within)
        for (const Plane& plane : cell)
            cut(part, plane.normal, plane.height, 4);
    return volumeOf(part);
}

} // namespace

Polyhedron boxOf(const Bounds& bounds) {
    const auto corner = [&](uint32_t k) {
        return Point{(k & 1 ? bounds.upper : bounds.lower)[0], (k & 2 ? bounds.upper : bounds.lower)[1],
                     (k & 4 ? bounds.upper : bounds.lower)[2]};
    };
    constexpr std::array<std::array<uint32_t, 4>, 6> kLoops = {
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    Polyhedron box;
    for (uint32_t f = 0; f < 6; ++f) {
        PolyhedronFace& face = box.faces.emplace_back(PolyhedronFace{kWallId + f, {}});
        for (const uint32_t k : kLoops[f])
            face.loop.push_back(corner(k));
    }
    return box;
}

void cut(Polyhedron& solid, const Point& normal, double height, uint32_t id) {
    const Plane plane = {normal, height};
    std::vector<Point> rim;
    std::vector<PolyhedronFace> kept;
    bool is_cut = false;
    for (const PolyhedronFace& face : solid.faces) {
        const bool crosses =
            std::any_of(face.loop.begin(), face.loop.end(), [&](const Point& p) { return plane.beyond(p) > 0; });
        is_cut = is_cut || crosses;
        std::vector<Point> loop = crosses ? clipped(face.loop, plane, rim) : face.loop;
        if (loop.size() >= 3) kept.push_back({face.id, std::move(loop)});
    }
    if (!is_cut) return;
    if (rim.size() >= 3) kept.push_back({id, loopAround(std::move(rim), normal)});
    solid.faces = std::move(kept);
    if (solid.faces.size() < 4) solid.faces.clear();
}

double volumeOf(const Polyhedron& solid) {
    if (solid.faces.empty()) return 0;
    const Point origin = solid.faces.front().loop.front();
    double sum = 0;
    for (const PolyhedronFace& face : solid.faces)
        sum += dot(face.loop[0] - origin, faceVector(face));
    return sum / 3;
}

double areaOf(const PolyhedronFace& face) { return length(faceVector(face)); }

std::vector<Polyhedron> voronoiCells(std::span<const Point> sites, const Bounds& box) {
    std::vector<Polyhedron> cells;
    for (uint32_t k = 0; k < sites.size(); ++k)
        cells.push_back(cellOf(sites, k, box));
    return cells;
}

std::vector<Polyhedron> cellsOfConvex(std::span<const Point> sites, std::span<const Triangle> model) {
    std::vector<Polyhedron> cells = voronoiCells(sites, boundsOf(model));
    for (const Triangle& t : model) {
        const Point across = cross(t[1] - t[0], t[2] - t[0]);
        if (!(length(across) > 0)) continue;
        const Point normal = (1 / length(across)) * across;
        for (Polyhedron& cell : cells)
            cut(cell, normal, dot(normal, t[0]), kModelId);
    }
    return cells;
}

std::vector<double> volumesWithin(std::span<const Triangle> model, std::span<const Polyhedron> cells) {
    const Point center = boundsOf(model).center();
    std::vector<std::vector<Plane>> planes;
    for (const Polyhedron& cell : cells)
        planes.push_back(planesOf(cell));
    std::vector<double> volumes(cells.size(), 0);
    for (const Triangle& t : model) {
        const double sign = dot(cross(t[1] - t[0], t[2] - t[0]), t[0] - center) < 0 ? -1 : 1;
        const std::array<Point, 4> corners = {t[0], sign > 0 ? t[1] : t[2], sign > 0 ? t[2] : t[1], center};
        for (size_t k = 0; k < cells.size(); ++k)
            volumes[k] += sign * volumeWithin(corners, planes[k]);
    }
    return volumes;
}

double distanceTo(const Triangle& t, const Point& p) {
    const Point normal = cross(t[1] - t[0], t[2] - t[0]);
    bool is_above = length(normal) > 0;
    double nearest = 1e300;
    for (size_t k = 0; k < 3; ++k) {
        const Point &a = t[k], along = t[(k + 1) % 3] - t[k];
        is_above = is_above && dot(cross(normal, along), p - a) >= 0;
        const double share = dot(along, along) > 0 ? std::clamp(dot(p - a, along) / dot(along, along), 0.0, 1.0) : 0;
        nearest = std::min(nearest, length(p - a - share * along));
    }
    return is_above ? std::fabs(dot(normal, p - t[0])) / length(normal) : nearest;
}

} // namespace reference
