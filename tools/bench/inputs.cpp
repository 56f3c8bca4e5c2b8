#include "tools/bench/inputs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

namespace bench {
namespace {

Point onUnitSphere(const Point& p) {
    const double length = std::hypot(p[0], p[1], p[2]);
    return {p[0] / length, p[1] / length, p[2] / length};
}

// Twelve vertices: the corners of three golden rectangles.
Model icosahedron() {
    constexpr double g = std::numbers::phi;
    Model model;
    model.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                      {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    model.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (Point& p : model.vertices)
        p = onUnitSphere(p);
    return model;
}

// Every triangle into four, the new vertices on the sphere.
void subdivide(Model& model) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
        const auto [entry, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<uint32_t>(model.vertices.size()));
        if (is_new) {
            const Point p = model.vertices[a], q = model.vertices[b];
            model.vertices.push_back(onUnitSphere({p[0] + q[0], p[1] + q[1], p[2] + q[2]}));
        }
        return entry->second;
    };
    std::vector<std::array<uint32_t, 3>> finer;
    for (const auto& [a, b, c] : model.triangles) {
        const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    model.triangles = std::move(finer);
}

Model unitSphere(uint32_t level) {
    Model model = icosahedron();
    for (uint32_t k = 0; k < level; ++k)
        subdivide(model);
    return model;
}

void place(Point& p, double radius) {
    for (double& x : p)
        x = static_cast<double>(static_cast<float>(.5 + radius * x));
}

} // namespace

Model smoothSphere(uint32_t level) {
    Model model = unitSphere(level);
    for (Point& p : model.vertices)
        place(p, .4);
    return model;
}

Model bumpySphere(uint32_t level) {
    Model model = unitSphere(level);
    for (Point& p : model.vertices)
        place(p, .4 * (1 + .25 * std::sin(6 * p[0]) * std::sin(5 * p[1]) * std::sin(7 * p[2])));
    return model;
}

std::vector<Point> uniformSites(uint32_t count, uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Point> sites(count);
    for (Point& site : sites)
        for (double& x : site)
            x = unit(random);
    return sites;
}

Model unitCube() {
    Model cube;
    for (uint32_t k = 0; k < 8; ++k)
        cube.vertices.push_back({double(k & 1), double(k >> 1 & 1), double(k >> 2)});
    cube.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return cube;
}

} // namespace bench
