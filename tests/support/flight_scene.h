// A scene without gravity, for bodies that fly at something. Free of any test's framework.
#pragma once

#include "modules/brittle/scene/scene_description.h"

namespace support {

// Holds no body yet. Bodies touch, rub and bounce.
inline brittle::SceneDescription flightScene() {
    brittle::SceneDescription scene;
    scene.gravity = {0, 0, 0};
    scene.effects = {"contacts", "friction", "restitution"};
    return scene;
}

} // namespace support
