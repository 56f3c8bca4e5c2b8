// brittle_peer_cgal LEVEL SITES SEED: shatters the bench's model with CGAL and prints one line.
#include "tools/bench/peers.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
namespace Processing = CGAL::Polygon_mesh_processing;

Surface surfaceOf(const bench::Model& model) {
    Surface surface;
    std::vector<Surface::Vertex_index> vertices;
    for (const bench::Point& p : model.vertices)
        vertices.push_back(surface.add_vertex(Kernel::Point_3(p[0], p[1], p[2])));
    for (const auto& t : model.triangles)
        surface.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
    return surface;
}

// What an application would do with a convex cell: its hull, and the intersection of that with the model.
bool intersect(const Surface& model, const std::vector<bench::Point>& corners, Surface& fragment) {
    std::vector<Kernel::Point_3> points;
    points.reserve(corners.size());
    for (const bench::Point& p : corners)
        points.emplace_back(p[0], p[1], p[2]);
    Surface hull, copy = model;
    CGAL::convex_hull_3(points.begin(), points.end(), hull);
    try {
        return Processing::corefine_and_compute_intersection(copy, hull, fragment);
    } catch (const std::exception&) {
        return false;
    }
}

bench::PeerShatter shatter(const Surface& model, const std::vector<std::vector<bench::Point>>& cells) {
    bench::PeerShatter result;
    double volume = 0;
    for (const std::vector<bench::Point>& corners : cells) {
        const auto begin = std::chrono::steady_clock::now();
        Surface fragment;
        const bool done = intersect(model, corners, fragment);
        result.ms += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
        const bool present = fragment.number_of_faces() > 0;
        if (!done || (present && !CGAL::is_closed(fragment)))
            ++result.failures;
        else if (present)
            ++result.fragments, volume += CGAL::to_double(Processing::volume(fragment));
    }
    const double whole = CGAL::to_double(Processing::volume(model));
    result.volume_error = std::abs(volume - whole) / whole;
    return result;
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 4) return std::fprintf(stderr, "usage: brittle_peer_cgal LEVEL SITES SEED\n"), 2;
    const auto number = [&](int k) { return std::strtoul(argv[k], nullptr, 10); };
    const Surface model = surfaceOf(bench::bumpySphere(static_cast<uint32_t>(number(1))));
    const auto cells = bench::cellCorners(bench::uniformSites(static_cast<uint32_t>(number(2)), number(3)));
    const bench::PeerShatter result = shatter(model, cells);
    std::printf("ms %.3f fragments %u failures %u volume_error %.3g\n", result.ms, result.fragments, result.failures,
                result.volume_error);
    return 0;
}
