#include "modules/brittle/scene/body_shape.h"

#include "modules/brittle/mesh/vector_math.h"
#include "modules/brittle/scene/shape_model.h"

#include <numbers>

namespace brittle {
namespace {

std::vector<Double3> boxPoints(const Double3& size) {
    std::vector<Double3> points;
    for (uint32_t v = 0; v < 8; ++v)
        points.push_back({(v & 1 ? 0.5 : -0.5) * size[0], (v & 2 ? 0.5 : -0.5) * size[1], (v & 4 ? 0.5 : -0.5) * size[2]});
    return points;
}

engine::Result<PointHull> hullOfHull(const ShapeDescription& shape, const std::filesystem::path& folder) {
    if (shape.file.empty()) return hullOfPoints(shape.points);
    const auto model = readModel(shape, folder);
    if (!model) return model.error();
    auto hull = hullOfPoints(model->positions);
    if (!hull) return engine::Error{hull.error().code, shape.file + ": " + hull.error().message};
    hull->reader_notes = model->notes;
    return hull;
}

} // namespace

std::vector<Double3> ballPoints(double radius, uint32_t count) {
    const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
    std::vector<Double3> points;
    for (uint32_t k = 0; k < count; ++k) {
        const double y = 1 - (2 * k + 1.0) / count, out = std::sqrt(1 - y * y);
        points.push_back(radius * Double3{out * std::cos(golden * k), y, out * std::sin(golden * k)});
    }
    return points;
}

engine::Result<PointHull> hullOf(const ShapeDescription& shape, const std::filesystem::path& folder) {
    switch (shape.kind) {
    case ShapeKind::Box: return hullOfPoints(boxPoints(shape.size));
    case ShapeKind::Ball: return hullOfPoints(ballPoints(shape.radius, shape.corners));
    case ShapeKind::Hull: return hullOfHull(shape, folder);
    case ShapeKind::Mesh: return engine::Error{engine::ErrorCode::BadInput, "a mesh has no hull of its own; its cells have"};
    case ShapeKind::Plane: return engine::Error{engine::ErrorCode::BadInput, "a plane has no hull"};
    }
    return engine::Error{engine::ErrorCode::BadInput, "no such shape"};
}

double massOf(const BodyDescription& body, double density, double volume) { return body.mass.value_or(density * volume); }

} // namespace brittle
