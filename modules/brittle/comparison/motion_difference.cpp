#include "modules/brittle/comparison/motion_difference.h"

#include "engine/buffer_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace brittle {
namespace {

using Bytes = std::span<const std::byte>;

bool exists(const gpu::BodyState& body) { return (body.sector.w & BODY_ABSENT) == 0; }

double lengthOf(double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); }

double distanceOf(const gpu::BodyState& a, const gpu::BodyState& b) {
    const auto along = [](int sector_a, int sector_b, float offset_a, float offset_b) {
        return SECTOR_EDGE * (double(sector_a) - sector_b) + (double(offset_a) - offset_b);
    };
    return lengthOf(along(a.sector.x, b.sector.x, a.offset.x, b.offset.x),
                    along(a.sector.y, b.sector.y, a.offset.y, b.offset.y),
                    along(a.sector.z, b.sector.z, a.offset.z, b.offset.z));
}

// Unit quaternions q and -q are the same rotation; their distance is twice the sine of a quarter of the angle.
double angleOf(const gpu::vec4& p, const gpu::vec4& q) {
    const std::array<double, 4> a = {p.x, p.y, p.z, p.w}, b = {q.x, q.y, q.z, q.w};
    double apart = 0, across = 0;
    for (size_t k = 0; k < a.size(); ++k) {
        apart += (a[k] - b[k]) * (a[k] - b[k]);
        across += (a[k] + b[k]) * (a[k] + b[k]);
    }
    return 4 * std::asin(std::min(1.0, std::sqrt(std::min(apart, across)) / 2));
}

struct Member {
    const char* name;
    const char* type;
    size_t offset;
};
constexpr Member kMembers[] = {
    {"sector", "int", offsetof(gpu::BodyState, sector)}, {"offset", "float", offsetof(gpu::BodyState, offset)},
    {"turn", "float", offsetof(gpu::BodyState, turn)},   {"velocity", "float", offsetof(gpu::BodyState, velocity)},
    {"spin", "float", offsetof(gpu::BodyState, spin)},   {"momentum", "float", offsetof(gpu::BodyState, momentum)}};
static_assert(sizeof(gpu::BodyState) == std::size(kMembers) * 16);

BodyDifference differenceOf(uint32_t body, Bytes a, Bytes b) {
    size_t at = 0;
    while (std::memcmp(a.data() + at, b.data() + at, 4) == 0)
        at += 4;
    const Member& member = kMembers[at / 16];
    return {body, std::string(member.name) + "." + "xyzw"[at % 16 / 4], engine::valueText(member.type, a.subspan(at, 4)),
            engine::valueText(member.type, b.subspan(at, 4))};
}

} // namespace

MotionDifference motionDifference(std::span<const gpu::BodyState> a, std::span<const gpu::BodyState> b) {
    MotionDifference difference;
    for (uint32_t k = 0; k < std::max(a.size(), b.size()); ++k) {
        const bool in_a = k < a.size() && exists(a[k]), in_b = k < b.size() && exists(b[k]);
        difference.only_a += in_a && !in_b ? 1 : 0;
        difference.only_b += in_b && !in_a ? 1 : 0;
        if (!in_a || !in_b) continue;
        ++difference.bodies;
        const double distance = distanceOf(a[k], b[k]);
        if (distance > difference.position_m) difference.body = k;
        const gpu::vec4 &u = a[k].velocity, &v = b[k].velocity;
        difference.position_m = std::max(difference.position_m, distance);
        difference.rotation_rad = std::max(difference.rotation_rad, angleOf(a[k].turn, b[k].turn));
        difference.linear_velocity =
            std::max(difference.linear_velocity, lengthOf(double(u.x) - v.x, double(u.y) - v.y, double(u.z) - v.z));
    }
    return difference;
}

std::optional<BodyDifference> firstBodyDifference(std::span<const gpu::BodyState> a, std::span<const gpu::BodyState> b) {
    for (uint32_t k = 0; k < std::min(a.size(), b.size()); ++k)
        if (std::memcmp(&a[k], &b[k], sizeof a[k]) != 0)
            return differenceOf(k, std::as_bytes(a.subspan(k, 1)), std::as_bytes(b.subspan(k, 1)));
    if (a.size() == b.size()) return std::nullopt;
    const auto shorter = static_cast<uint32_t>(std::min(a.size(), b.size()));
    return BodyDifference{shorter, "body", shorter < a.size() ? "exists" : "none", shorter < b.size() ? "exists" : "none"};
}

} // namespace brittle
