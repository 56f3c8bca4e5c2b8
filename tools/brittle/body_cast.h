// Who is in the slots of a world's bodies as it goes on: the bodies of its beginning, and fragments as they appear.
#pragma once

#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/dynamics/world.h"

#include <map>
#include <string>
#include <utility>

namespace cli {

// By what it was first a part of, the step that it was made in and its slot: nobody else ever has that name.
std::string fragmentName(const std::string& origin, uint32_t step, uint32_t slot);

class BodyCast {
public:
    // `surfaces` are those of all bodies of the world as it begins; they grow by the fragments that are seen.
    BodyCast(brittle::World& world, brittle::WorldSurfaces& surfaces) : world_(world), surfaces_(surfaces) {}

    // Of all that has been seen so far, in the order of WorldSurfaces::bodies, where it is now.
    engine::Result<brittle::Poses> poses();

private:
    using Key = std::pair<uint32_t, uint32_t>; // slot and step that a fragment was made in
    engine::Result<void> meet(std::span<const brittle::BodyFragment> fragments);
    void add(const brittle::BodyFragment& fragment, brittle::SurfaceMesh surface);

    brittle::World& world_;
    brittle::WorldSurfaces& surfaces_;
    size_t beginning_ = surfaces_.bodies.size();
    std::map<Key, size_t> looks_; // of fragments
};

} // namespace cli
