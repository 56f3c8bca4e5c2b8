#include "tests/support/scaled_scene.h"

#include "modules/brittle/mesh/vector_math.h"

#include <cmath>

namespace support {
namespace {

using brittle::operator*;

void scaleShape(brittle::ShapeDescription& shape, double scale) {
    shape.size = scale * shape.size;
    shape.radius *= scale;
    shape.scale = scale * shape.scale;
    for (brittle::Double3& point : shape.points)
        point = scale * point;
    shape.cells.at = scale * shape.cells.at;
    shape.cells.inflate *= scale;
    shape.cells.strength *= std::pow(scale, 4);
}

void scaleStep(brittle::StepDescription& step, double scale) {
    const double slower = std::sqrt(scale);
    step.dt *= slower;
    step.margin *= scale;
    step.bounce_speed *= slower;
    step.push_out *= slower;
    step.contact_hertz /= slower;
}

void scaleEffects(brittle::SceneDescription& scene, double scale) {
    const double slower = std::sqrt(scale);
    scene.breaking.smallest_piece *= scale;
    scene.dust.lifetime *= slower;
    scene.debris.below *= scale;
    scene.debris.after *= slower;
    scene.debris.fade *= slower;
    scene.events.impact_speed *= slower;
}

void scaleBody(brittle::BodyDescription& body, double scale) {
    const double slower = std::sqrt(scale);
    scaleShape(body.shape, scale);
    body.place = scale * body.place;
    body.velocity = slower * body.velocity;
    body.spin = (1 / slower) * body.spin;
    if (body.mass) *body.mass *= scale * scale * scale;
}

} // namespace

brittle::SceneDescription scaled(brittle::SceneDescription scene, double scale) {
    scaleStep(scene.step, scale);
    scaleEffects(scene, scale);
    for (brittle::ColliderDescription& collider : scene.colliders) {
        scaleShape(collider.shape, scale);
        collider.place = scale * collider.place;
    }
    for (brittle::BodyDescription& body : scene.bodies)
        scaleBody(body, scale);
    return scene;
}

} // namespace support
