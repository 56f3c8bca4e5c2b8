// Models made by code: for demos, benches and tests, and for trying things out where there is no file at hand.
#pragma once

#include "engine/result.h"
#include "modules/brittle/mesh/imported_mesh.h"

#include <string>
#include <string_view>

namespace brittle {

// A thick ring of rounded square section that makes three quarter turns on its way around: not convex, with a hole through it.
ImportedMesh makeTwistedRing();
// The unit cube about the origin, 12 triangles, sharp edges.
ImportedMesh makeCube();
// A sphere of radius 1 made of 20 * 4^level triangles.
ImportedMesh makeIcosphere(uint32_t level);
// The same with bumps and hollows, deep enough that no large part of it is convex.
ImportedMesh makeBumpySphere(uint32_t level);

constexpr uint32_t kMaxSphereLevel = 8; // 1,310,720 triangles

// "ring", "cube", "icosphere:LEVEL" or "bumpy:LEVEL"; levels may be left out.
engine::Result<ImportedMesh> makeBuiltin(std::string_view name);
std::string builtinNames();

} // namespace brittle
