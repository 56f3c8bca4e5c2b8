// Finds the sites within a distance of a point, by a grid of about two sites a cell.
#pragma once

#include "modules/brittle/mesh/vector_math.h"

#include <span>

namespace brittle {

class SiteGrid {
public:
    explicit SiteGrid(std::span<const Double3> sites);
    // Appends the indices of all sites nearer than the radius, in no order.
    void findNear(const Double3& center, double radius, std::vector<uint32_t>& found) const;

private:
    std::array<uint32_t, 3> cellOf(const Double3& p) const;
    size_t slotOf(const std::array<uint32_t, 3>& cell) const { return (cell[2] * size_[1] + cell[1]) * size_[0] + cell[0]; }

    std::span<const Double3> sites_;
    Box box_;
    std::array<size_t, 3> size_ = {1, 1, 1};
    Double3 scale_ = {0, 0, 0};
    std::vector<uint32_t> first_; // of every slot, into order_
    std::vector<uint32_t> order_;
};

} // namespace brittle
