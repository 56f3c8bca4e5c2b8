// A model whose level cuts have outlines of thousands of sides.
#pragma once

#include "modules/brittle/mesh/imported_mesh.h"

#include <random>

namespace support {

// Makes a box whose top is a rough field of `squares` by `squares`.
inline brittle::ImportedMesh roughBlock(uint32_t squares) {
    std::mt19937 random(7);
    brittle::ImportedMesh block;
    const uint32_t row = squares + 1;
    const auto at = [&](uint32_t layer, uint32_t i, uint32_t j) { return layer * row * row + i * row + j; };
    for (const uint32_t layer : {0u, 1u})
        for (uint32_t i = 0; i < row; ++i)
            for (uint32_t j = 0; j < row; ++j) {
                const bool is_rim = i == 0 || j == 0 || i == squares || j == squares;
                const double rise = layer == 0 || is_rim ? 0 : 0.02 * static_cast<double>(random() % 1000) / 1000;
                block.positions.push_back(
                    {static_cast<double>(i) / squares, 0.3 * layer + rise, static_cast<double>(j) / squares});
            }
    const auto add = [&](uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
        block.triangles.push_back({a, b, c});
        block.triangles.push_back({a, c, d});
    };
    for (uint32_t i = 0; i < squares; ++i)
        for (uint32_t j = 0; j < squares; ++j) {
            add(at(1, i, j), at(1, i, j + 1), at(1, i + 1, j + 1), at(1, i + 1, j));
            add(at(0, i, j), at(0, i + 1, j), at(0, i + 1, j + 1), at(0, i, j + 1));
        }
    for (uint32_t i = 0; i < squares; ++i) {
        add(at(0, i, 0), at(1, i, 0), at(1, i + 1, 0), at(0, i + 1, 0));
        add(at(0, i + 1, squares), at(1, i + 1, squares), at(1, i, squares), at(0, i, squares));
        add(at(0, 0, i + 1), at(1, 0, i + 1), at(1, 0, i), at(0, 0, i));
        add(at(0, squares, i), at(1, squares, i), at(1, squares, i + 1), at(0, squares, i + 1));
    }
    block.corner_normals.assign(3 * block.triangles.size(), {0, 0, 0});
    block.corner_uvs.assign(3 * block.triangles.size(), {0, 0});
    return block;
}

} // namespace support
