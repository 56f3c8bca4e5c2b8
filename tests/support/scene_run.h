// A scene on the tests' device. What fails there fails the test.
#pragma once

#include "tests/support/measured_scene.h"

#include <string>

namespace support {

class SceneRun : public MeasuredScene {
public:
    explicit SceneRun(const std::string& name); // of a built-in scene
    explicit SceneRun(const brittle::SceneDescription& scene);

    void step(uint32_t steps);
    void finish() { step(stepsLeft()); }

private:
    bool is_there_ = false;
};

} // namespace support
