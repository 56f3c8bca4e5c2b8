#include "tools/brittle/shown_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace cli {
namespace {

constexpr double kGoldenPart = 0.6180339887498949;
constexpr double kFamily = 0.06; // of all hues, those of what was one body
constexpr float kGround = 0.34f, kShade = 0.45f;

struct Tint {
    double hue, saturation, value;
};

struct MaterialTint {
    std::string_view material;
    Tint tint;
};

constexpr MaterialTint kTints[] = {{"glass", {0.47, 0.22, 0.74}}, {"ice", {0.55, 0.14, 0.82}},
                                   {"brick", {0.03, 0.55, 0.55}}, {"concrete", {0.12, 0.06, 0.58}},
                                   {"stone", {0.1, 0.14, 0.5}},   {"porcelain", {0.12, 0.05, 0.8}}};
constexpr double kOwnSaturation = 0.37, kOwnValue = 0.72; // of bodies of other materials

// Built-in materials look alike everywhere; other bodies have hues that tell them apart.
Tint tintOf(const brittle::BodyLook& look, size_t number) {
    const auto* known = std::ranges::find(kTints, look.material, &MaterialTint::material);
    if (known != std::end(kTints)) return known->tint;
    const double hue = 0.07 + kGoldenPart * static_cast<double>(look.origin.value_or(static_cast<uint32_t>(number)));
    return {hue, kOwnSaturation, kOwnValue};
}

// A hue from 0 to 1 by the usual six ramps, as a linear color.
std::array<float, 3> colorOfHue(double hue, double saturation, double value) {
    std::array<float, 3> color;
    for (size_t k = 0; k < 3; ++k) {
        const double place = std::fmod(6 * hue + 5 - 2 * static_cast<double>(k), 6);
        const double less = std::fmax(0, std::fmin(std::fmin(place, 4 - place), 1));
        color[k] = static_cast<float>(std::pow(value * (1 - saturation * less), 2.2));
    }
    return color;
}

gpu::vec4 packed(const std::array<float, 3>& color, float w) { return {color[0], color[1], color[2], w}; }

} // namespace

gpu::ObjectColor colorOf(const brittle::BodyLook& look, size_t number, double fading_distance) {
    const auto end = static_cast<float>(fading_distance);
    if (look.is_plane) return {{kGround, kGround, kGround * 1.03f, 1}, {kGround, kGround, kGround, end}};
    if (!look.moves) return {{0.45f, 0.45f, 0.46f, 1}, {0.45f, 0.45f, 0.46f, 0}};
    const double share = std::fmod(7 * kGoldenPart * static_cast<double>(number), 1); // from 0 to 1, one of many
    const Tint tint = tintOf(look, number);
    const double hue = std::fmod(tint.hue + (look.origin ? kFamily * (share - 0.5) + 1 : 0), 1);
    const double value = tint.value + 0.16 * share, inner_saturation = std::fmin(tint.saturation * 1.5, 1);
    return {packed(colorOfHue(hue, tint.saturation, value), 1), packed(colorOfHue(hue, inner_saturation, 0.72 * value), 0)};
}

gpu::ObjectColor dustColor(const brittle::BodyLook& look, size_t number) {
    const gpu::ObjectColor own = colorOf(look, number, 0);
    const auto paler = [](float c) { return 0.75f * c + 0.12f; };
    return {{paler(own.outer.x), paler(own.outer.y), paler(own.outer.z), 0}, own.inner};
}

gpu::ObjectColor shadowColor(double fading_distance) {
    const float shade = kGround * kShade;
    return {{shade, shade, 1.08f * shade, 0}, {shade, shade, 1.08f * shade, static_cast<float>(fading_distance)}};
}

} // namespace cli
