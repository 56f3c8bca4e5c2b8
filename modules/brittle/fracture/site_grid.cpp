#include "modules/brittle/fracture/site_grid.h"

#include <algorithm>

namespace brittle {

SiteGrid::SiteGrid(std::span<const Double3> sites) : sites_(sites), order_(sites.size()) {
    for (const Double3& site : sites)
        box_.grow(site);
    const double steps = std::clamp(std::cbrt(static_cast<double>(sites.size()) / 2), 1.0, 256.0);
    for (size_t c = 0; c < 3 && !sites.empty(); ++c) {
        const double side = box_.upper[c] - box_.lower[c];
        size_[c] = side > 0 ? static_cast<size_t>(steps) : 1;
        scale_[c] = side > 0 ? static_cast<double>(size_[c]) / side : 0;
    }
    first_.assign(size_[0] * size_[1] * size_[2] + 1, 0);
    for (const Double3& site : sites)
        ++first_[slotOf(cellOf(site)) + 1];
    for (size_t slot = 1; slot < first_.size(); ++slot)
        first_[slot] += first_[slot - 1];
    std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
    for (uint32_t s = 0; s < sites.size(); ++s)
        order_[next[slotOf(cellOf(sites[s]))]++] = s;
}

std::array<uint32_t, 3> SiteGrid::cellOf(const Double3& p) const {
    std::array<uint32_t, 3> cell;
    for (size_t c = 0; c < 3; ++c)
        cell[c] = static_cast<uint32_t>(std::clamp((p[c] - box_.lower[c]) * scale_[c], 0.0, static_cast<double>(size_[c] - 1)));
    return cell;
}

void SiteGrid::findNear(const Double3& center, double radius, std::vector<uint32_t>& found) const {
    const Double3 reach = {radius, radius, radius};
    const auto low = cellOf(center - reach), high = cellOf(center + reach);
    for (uint32_t z = low[2]; z <= high[2]; ++z)
        for (uint32_t y = low[1]; y <= high[1]; ++y)
            for (uint32_t x = low[0]; x <= high[0]; ++x) {
                const size_t slot = slotOf({x, y, z});
                for (uint32_t k = first_[slot]; k < first_[slot + 1]; ++k) {
                    const Double3 apart = sites_[order_[k]] - center;
                    if (dot(apart, apart) < radius * radius) found.push_back(order_[k]);
                }
            }
}

} // namespace brittle
