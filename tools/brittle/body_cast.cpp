#include "tools/brittle/body_cast.h"

#include <algorithm>

namespace cli {

using engine::Result;

std::string fragmentName(const std::string& origin, uint32_t step, uint32_t slot) {
    return origin + "/" + std::to_string(step) + "." + std::to_string(slot);
}

Result<brittle::Poses> BodyCast::poses() {
    const auto states = world_.bodies();
    if (!states) return states.error();
    const auto fragments = world_.fragments();
    if (!fragments) return fragments.error();
    if (auto met = meet(*fragments); !met) return met.error();
    brittle::Poses poses(surfaces_.bodies.size());
    for (size_t body = 0; body < beginning_; ++body)
        if (((*states)[body].sector.w & BODY_ABSENT) == 0) poses[body] = brittle::poseOf((*states)[body]);
    for (const brittle::BodyFragment& fragment : *fragments) {
        if (fragment.slot < beginning_) poses[fragment.slot].reset(); // it has taken the place of a body that broke
        brittle::Pose pose = brittle::poseOf((*states)[fragment.slot]);
        pose.scale = double{fragment.fade};
        poses[looks_.at({fragment.slot, fragment.step})] = pose;
    }
    return poses;
}

// Only surfaces that were not seen before are read.
Result<void> BodyCast::meet(std::span<const brittle::BodyFragment> fragments) {
    std::vector<brittle::BodyFragment> fresh;
    std::ranges::copy_if(fragments, std::back_inserter(fresh), [&](const auto& fragment) {
        return !looks_.contains({fragment.slot, fragment.step});
    });
    auto surfaces = world_.surfacesOf(fresh);
    if (!surfaces) return surfaces.error();
    for (size_t k = 0; k < fresh.size(); ++k)
        add(fresh[k], std::move((*surfaces)[k]));
    return {};
}

void BodyCast::add(const brittle::BodyFragment& fragment, brittle::SurfaceMesh surface) {
    const auto mesh = static_cast<uint32_t>(surfaces_.meshes.size());
    const std::string name = fragmentName(surfaces_.bodies[fragment.origin].name, fragment.step, fragment.slot);
    looks_[{fragment.slot, fragment.step}] = surfaces_.bodies.size();
    surfaces_.meshes.push_back(std::move(surface));
    const std::string material = surfaces_.bodies[fragment.origin].material;
    surfaces_.bodies.push_back({mesh, name, true, false, fragment.origin, material});
}

} // namespace cli
