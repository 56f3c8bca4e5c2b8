#include "tools/brittle/drop.h"

#include "engine/camera.h"
#include "modules/brittle/mesh/vector_math.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace cli {
namespace {

using brittle::Double3;
using brittle::operator+, brittle::operator-, brittle::operator*; // of arrays, which argument-dependent lookup does not find

constexpr double kCoarsest = 1.0 / 60;              // s, of a step
constexpr double kCoarseSize = 0.5;                 // m: models that are smaller have shorter steps, by the root of their size
constexpr double kMargin = 0.02, kMarginPart = 0.1; // m; of the size of a fragment
constexpr double kRoom = 0.6;                       // in diagonals of the model
constexpr engine::Vec3 kViewFrom = {0.5f, 0.42f, 1};

brittle::Box boxOf(const brittle::FragmentSet& set) {
    brittle::Box box;
    for (const brittle::Fragment& f : set.fragments) {
        box.grow(set.center + brittle::toDouble(f.lower));
        box.grow(set.center + brittle::toDouble(f.upper));
    }
    return box;
}

// The edge of a cube of the median volume: where sites crowd, most fragments are far smaller than their mean.
double usualSize(const brittle::FragmentSet& set) {
    std::vector<double> volumes;
    for (const brittle::Fragment& f : set.fragments)
        volumes.push_back(f.volume);
    const auto middle = volumes.begin() + static_cast<std::ptrdiff_t>(volumes.size() / 2);
    std::ranges::nth_element(volumes, middle);
    return std::cbrt(*middle);
}

double stepFor(double size) {
    const double parts = std::ceil(std::sqrt(kCoarseSize / size));
    return kCoarsest / std::clamp(parts, 1.0, 1000.0);
}

// All of the way down, and room beside it for what rolls away.
brittle::CameraDescription cameraFor(const brittle::Box& box, double ground) {
    const double room = kRoom * box.diagonal();
    const Double3 lower = {box.lower[0] - room, ground, box.lower[2] - room};
    const Double3 upper = {box.upper[0] + room, box.upper[1], box.upper[2] + room};
    brittle::CameraDescription camera;
    const Double3 middle = 0.5 * (lower + upper);
    const engine::Camera framed =
        engine::frameBounds(brittle::toFloat(lower - middle), brittle::toFloat(upper - middle),
                            static_cast<float>(camera.width) / static_cast<float>(camera.height), kViewFrom);
    camera.eye = middle + brittle::toDouble(framed.eye);
    camera.target = middle + brittle::toDouble(framed.target);
    camera.field_of_view = double{framed.fov_y} * 180 / std::numbers::pi;
    return camera;
}

} // namespace

brittle::SceneDescription dropScene(const std::string& model, const brittle::FragmentSet& fragments,
                                    std::optional<double> height) {
    const brittle::Box box = boxOf(fragments);
    const double ground = box.lower[1] - height.value_or((box.upper[1] - box.lower[1]) / 2);
    brittle::SceneDescription scene;
    scene.name = model;
    scene.step.dt = stepFor(box.diagonal());
    scene.step.margin = std::min(kMargin, kMarginPart * usualSize(fragments));
    scene.camera = cameraFor(box, ground);
    brittle::BodyDescription& body = scene.bodies.emplace_back();
    body.name = "fragment";
    body.shape.kind = brittle::ShapeKind::Mesh;
    body.shape.cells.broken = true;
    body.place = fragments.center;
    brittle::ColliderDescription& plane = scene.colliders.emplace_back();
    plane.name = "ground";
    plane.place = {fragments.center[0], ground, fragments.center[2]};
    return scene;
}

} // namespace cli
