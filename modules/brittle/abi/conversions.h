// Between the C ABI's structs and those of scenes.
#pragma once

#include "modules/brittle/abi/context.h"

namespace brittle::abi {

inline Double3 tripleOf(const BrittleVec3& v) { return {v.x, v.y, v.z}; }
inline BrittleVec3 vectorOf(const Double3& v) { return {v[0], v[1], v[2]}; }
inline BrittleVec3 vectorOf(const gpu::vec4& v) { return {v.x, v.y, v.z}; }
inline Quaternion turnOf(const BrittleQuat& q) { return {q.x, q.y, q.z, q.w}; }
inline BrittleQuat quatOf(const Turn& t) { return {t[0], t[1], t[2], t[3]}; }

// Of the world as it is to be; nothing is in it. Refuses effects that are none.
SceneDescription sceneOf(const BrittleWorldDef& def);
// Refuses meshes that are none, and kinds that are none.
ShapeDescription shapeOf(const BrittleContext& context, const BrittleShape& shape, bool moves);
BodyDescription bodyOf(const BrittleContext& context, HostedWorld& world, const BrittleBodyDef& def);
ColliderDescription colliderOf(const BrittleContext& context, const BrittleColliderDef& def);

} // namespace brittle::abi
