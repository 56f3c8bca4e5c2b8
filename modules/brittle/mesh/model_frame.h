// Unit and axes of a model file, and the way from there to Brittle's: meters, x to the right, y up, z to the front.
#pragma once

#include "modules/brittle/mesh/transform.h"

#include <string>
#include <vector>

namespace brittle {

// An axis of the file. `index` 0 to 2 is x, y, z; `sign` is -1 where it points the other way.
struct FileAxis {
    int index = 0;
    int sign = 1;
    bool operator==(const FileAxis&) const = default;
};

struct ModelFrame {
    double meters_per_unit = 1;
    FileAxis right = {0, 1}, up = {1, 1}, front = {2, 1};
};

// Every axis once, a positive and finite unit.
bool isPossible(const ModelFrame& frame);

Transform toMeters(const ModelFrame& frame);

// Finds the frame from which `transform` leads to ours. False if the transform does more than scale evenly and swap axes.
bool findFrame(const Transform& transform, ModelFrame& frame);

// Describes what toMeters changes, in sentences. Empty if it changes nothing.
std::vector<std::string> describeFrame(const ModelFrame& frame);

// The shortest decimal that rounds to this float: 0.01, not 0.00999999978. Files hold decimals.
double fromShortFloat(float value);

} // namespace brittle
