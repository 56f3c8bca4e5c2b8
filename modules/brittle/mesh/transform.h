// Affine transforms in double: a model may lie far from the origin by its node's translation alone.
#pragma once

#include "modules/brittle/mesh/vector_math.h"

namespace brittle {

struct Transform {
    std::array<Double3, 3> rows = {Double3{1, 0, 0}, Double3{0, 1, 0}, Double3{0, 0, 1}};
    Double3 offset = {0, 0, 0};

    Double3 turned(const Double3& p) const { return {dot(rows[0], p), dot(rows[1], p), dot(rows[2], p)}; }
    Double3 moved(const Double3& p) const { return turned(p) + offset; }
    Double3 column(size_t c) const { return {rows[0][c], rows[1][c], rows[2][c]}; }
    // True for scales of 0: they leave zeros in a column or a row, beside one rotation.
    bool isFlat() const {
        const Double3 zero = {0, 0, 0};
        for (size_t k = 0; k < 3; ++k)
            if (column(k) == zero || rows[k] == zero) return true;
        return false;
    }
    double determinant() const { return dot(rows[0], cross(rows[1], rows[2])); }
    // Uses the cofactors, so that normals stay upright under uneven scale.
    Double3 turnedNormal(const Double3& n) const {
        const double sign = determinant() < 0 ? -1 : 1;
        const std::array<Double3, 3> cofactors = {cross(rows[1], rows[2]), cross(rows[2], rows[0]), cross(rows[0], rows[1])};
        return sign * Double3{dot(cofactors[0], n), dot(cofactors[1], n), dot(cofactors[2], n)};
    }
};

inline Transform operator*(const Transform& a, const Transform& b) {
    Transform product;
    for (size_t r = 0; r < 3; ++r)
        product.rows[r] = {dot(a.rows[r], b.column(0)), dot(a.rows[r], b.column(1)), dot(a.rows[r], b.column(2))};
    product.offset = a.moved(b.offset);
    return product;
}

} // namespace brittle
