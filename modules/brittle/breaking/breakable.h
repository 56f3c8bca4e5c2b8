// What bodies need to break: their surface, which is cut, and what they are made of.
#pragma once

#include "modules/brittle/dynamics/body_surface.h"
#include "modules/brittle/effects/material.h"

namespace brittle {

// Of a body that does not break, or of none.
gpu::BreakableBody unbreakable();

struct BreakableDefinition {
    uint32_t body = 0;   // of the contents
    SurfaceMesh surface; // closed; about the center of mass, along the axes that `definition` is described in
    const BodyDefinition& definition;
    const Material& material;
    double volume = 0; // m3, of the surface
    uint64_t seed = 1; // of how strong it is, with the body's number
    uint32_t pattern = PATTERN_IMPACT;
};

// From now on the body can break. Errors: BadInput for a surface without triangles or a volume that is none.
engine::Result<void> makeBreakable(WorldContents& contents, const BreakableDefinition& definition);

} // namespace brittle
