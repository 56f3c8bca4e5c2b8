#include "tests/kernel/random_pairs.h"

#include <algorithm>
#include <cmath>

namespace kernel_test {
namespace {

using reference::dot;
using reference::length;
using reference::Point;
using reference::operator+;
using reference::operator*;

double uniform(std::mt19937& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

Place randomDirection(std::mt19937& random) {
    std::normal_distribution<double> normal;
    const Point p = {normal(random), normal(random), normal(random)};
    return (1 / length(p)) * p;
}

// Its coordinates times the factor, as floats again.
Shape scaled(Shape shape, double factor) {
    for (auto& v : shape.vertices)
        for (float& x : v)
            x = static_cast<float>(factor * static_cast<double>(x));
    return shape;
}

double reachOf(const Shape& shape, const Turn& turn, const Place& direction) {
    double reach = -1e300;
    for (const auto& v : shape.vertices)
        reach = std::max(reach, dot(direction, turned(turn, {v[0], v[1], v[2]})));
    return reach;
}

Shape formOf(std::mt19937& random, uint32_t kind) {
    const auto size = [&] { return uniform(random, .2, .6); };
    if (kind % 8 == 0) return boxShape({size(), size(), size()});
    const uint32_t planes = kind % 8 == 1 ? 2 : 4 + static_cast<uint32_t>(random() % 55);
    const double thin = kind % 8 == 2 ? .01 : uniform(random, .3, .8);
    return cellShape(random, planes, {.8, uniform(random, .3, .8), thin});
}

} // namespace

void addForms(HullScene& scene, std::mt19937& random, uint32_t count) {
    scene.add(
        {{{0, 0, .9f}, {.8f, 0, -.3f}, {-.4f, .7f, -.3f}, {-.4f, -.7f, -.3f}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}});
    while (scene.shapes.size() < count)
        scene.add(formOf(random, static_cast<uint32_t>(scene.shapes.size())));
}

void addRandomPairs(HullScene& scene, std::mt19937& random, uint32_t forms, uint32_t count) {
    const auto start = static_cast<uint32_t>(scene.shapes.size());
    for (uint32_t k = 0; k < count; ++k) {
        const bool near_parallel = k % 2 == 0;
        const uint32_t form = static_cast<uint32_t>(random() % forms);
        const uint32_t other = k % 4 == 0 ? form : static_cast<uint32_t>(random() % forms);
        const double size = std::pow(10.0, uniform(random, -3, 1)),
                     ratio = k % 4 == 0 ? 1 : std::pow(10.0, uniform(random, -1, 1));
        const Turn turn = turnAbout(randomDirection(random), uniform(random, 0, 3.1));
        const Turn against =
            turnAbout(randomDirection(random), near_parallel ? uniform(random, 0, .01) : uniform(random, 0, 3.1));
        const Shape a = scaled(scene.shapes[form], size);
        const Shape b = scaled(scene.shapes[other], std::clamp(size * ratio, 1e-3, 10.0));
        const Place way = randomDirection(random);
        const Turn b_turn = after(against, turn);
        const double touching = reachOf(a, turn, way) + reachOf(b, b_turn, -1.0 * way);
        const double share = k % 3 == 0 ? uniform(random, .98, 1.01) : uniform(random, 0, 1.2);
        scene.addPair({scene.add(a), {0, 0, 0}, turn}, {scene.add(b), share * touching * way, b_turn});
    }
    ENGINE_ASSERT(scene.shapes.size() == start + 2 * count);
}

} // namespace kernel_test
