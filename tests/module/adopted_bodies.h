// Bodies that were adopted, next to the ones that the host makes of the same fragments.
#pragma once

#include "tests/module/adopting.h"

#include <Eigen/Dense>

namespace adopting {

using Eigen::Matrix3d, Eigen::Quaterniond, Eigen::Vector3d;

inline Vector3d vec(const gpu::vec4& v) { return {v.x, v.y, v.z}; }
inline Vector3d vec(const brittle::Double3& v) { return {v[0], v[1], v[2]}; }
inline brittle::Double3 triple(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline Quaterniond rotation(const gpu::vec4& q) { return Quaterniond(q.w, q.x, q.y, q.z).normalized(); }
Vector3d placeOf(const gpu::BodyState& state);   // of the center of mass
Vector3d momentsOf(const gpu::BodyShape& shape); // principal ones

const brittle::Fragment& fragmentOf(const Scene& scene, const Part& part);
double wholeMass(const Object& o);
double densityOf(const Object& o);
// From the frame of its vertices to the world.
Quaterniond frameOf(const Object& o);
// From the whole's center of mass, world axes, to a place that counts from the middle of its mesh.
Vector3d wayTo(const Object& o, const brittle::Double3& p);

// Masses, motions, inertia, hulls: those of the host, and each hull closed.
void expectBodies(const Scene& scene, const World& world);

} // namespace adopting
