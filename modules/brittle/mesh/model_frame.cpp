#include "modules/brittle/mesh/model_frame.h"

#include <charconv>
#include <cstdio>

namespace brittle {
namespace {

Double3 rowOf(const FileAxis& axis, double scale) {
    Double3 row = {0, 0, 0};
    row[static_cast<size_t>(axis.index)] = axis.sign * scale;
    return row;
}

// The axis along which the row points, if it is one.
bool findAxis(const Double3& row, double scale, FileAxis& axis) {
    constexpr double kRounding = 1e-5; // of matrices in float
    int found = 0;
    for (int k = 0; k < 3; ++k) {
        const double share = row[static_cast<size_t>(k)] / scale;
        if (std::abs(share) <= kRounding) continue;
        if (std::abs(std::abs(share) - 1) > kRounding) return false;
        axis = {k, share < 0 ? -1 : 1};
        ++found;
    }
    return found == 1;
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}

std::string nameOf(const FileAxis& axis) {
    const char name = "xyz"[axis.index];
    return axis.sign < 0 ? std::string("-") + name : std::string(1, name);
}

} // namespace

bool isPossible(const ModelFrame& frame) {
    bool seen[3] = {false, false, false};
    for (const FileAxis& axis : {frame.right, frame.up, frame.front}) {
        if (axis.index < 0 || axis.index > 2 || std::abs(axis.sign) != 1 || seen[axis.index]) return false;
        seen[axis.index] = true;
    }
    return std::isfinite(frame.meters_per_unit) && frame.meters_per_unit > 0;
}

Transform toMeters(const ModelFrame& frame) {
    Transform transform;
    transform.rows = {rowOf(frame.right, frame.meters_per_unit), rowOf(frame.up, frame.meters_per_unit),
                      rowOf(frame.front, frame.meters_per_unit)};
    return transform;
}

bool findFrame(const Transform& transform, ModelFrame& frame) {
    const double scale = length(transform.rows[0]);
    if (!(scale > 0) || !std::isfinite(scale) || transform.offset != Double3{0, 0, 0}) return false;
    frame.meters_per_unit = fromShortFloat(static_cast<float>(scale));
    return findAxis(transform.rows[0], scale, frame.right) && findAxis(transform.rows[1], scale, frame.up) &&
           findAxis(transform.rows[2], scale, frame.front) && isPossible(frame);
}

std::vector<std::string> describeFrame(const ModelFrame& frame) {
    std::vector<std::string> notes;
    if (frame.meters_per_unit != 1)
        notes.push_back("unit: " + number(100 * frame.meters_per_unit) + " cm; scaled by " + number(frame.meters_per_unit) +
                        " to meters");
    const ModelFrame ours;
    if (frame.up != ours.up)
        notes.push_back(nameOf(frame.up) + " up: turned so that y is up");
    else if (frame.front != ours.front)
        notes.push_back("front at " + nameOf(frame.front) + ": turned so that it is at z");
    if (toMeters(frame).determinant() < 0) notes.push_back("left-handed axes: mirrored, so that they are right-handed");
    return notes;
}

double fromShortFloat(float value) {
    char text[32];
    const auto written = std::to_chars(text, text + sizeof text, value);
    double result = static_cast<double>(value);
    std::from_chars(text, written.ptr, result);
    return result;
}

} // namespace brittle
