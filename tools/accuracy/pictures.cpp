// The same break, and the same pile, under the cheapest and the dearest of the settings that were measured, and where the two
// pictures differ.
#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/dynamics/scene_contents.h"
#include "modules/brittle/dynamics/scene_settings.h"
#include "modules/brittle/scene/library/builtin_scenes.h"
#include "tools/accuracy/dynamics_settings.h"
#include "tools/accuracy/fracture_run.h"
#include "tools/brittle/picture.h"
#include "tools/brittle/world_picture.h"

#include <algorithm>
#include <cmath>

namespace accuracy {
namespace {

using engine::Picture;
using engine::Result;

constexpr cli::PictureSize kSize = {640, 480};
constexpr double kExplode = 0.25, kSeconds = 3;
constexpr int kNoticedShade = 24; // of 255, in any channel
constexpr int kMarkReach = 2;     // pixels
constexpr std::array<uint8_t, 3> kMark = {200, 0, 90};

std::string base64(const std::string& bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t k = 0; k < bytes.size(); k += 3) {
        uint32_t word = 0;
        for (size_t b = 0; b < 3; ++b)
            word = word << 8 | (k + b < bytes.size() ? static_cast<uint8_t>(bytes[k + b]) : 0);
        for (size_t d = 0; d < 4; ++d)
            text += k + d <= bytes.size() ? kDigits[word >> (18 - 6 * d) & 63] : '=';
    }
    return text;
}

std::string dataUri(const Picture& picture) { return "data:image/png;base64," + base64(engine::encodePng(picture)); }

struct Marked {
    Picture picture; // the second one in gray, with what differs in color
    double share = 0;
};

bool differAt(const Picture& a, const Picture& b, size_t pixel) {
    int most = 0;
    for (size_t k = 0; k < 3; ++k)
        most = std::max(most, std::abs(int{a.pixels[4 * pixel + k]} - int{b.pixels[4 * pixel + k]}));
    return most > kNoticedShade;
}

// Gray and pale, so that marks stand out.
Picture faded(Picture picture) {
    for (size_t p = 0; p < picture.pixels.size(); p += 4) {
        const int gray = picture.pixels[p] + picture.pixels[p + 1] + picture.pixels[p + 2];
        for (size_t k = 0; k < 3; ++k)
            picture.pixels[p + k] = static_cast<uint8_t>(128 + gray / 6);
    }
    return picture;
}

// Larger than a pixel, to be seen.
void mark(Picture& picture, size_t pixel) {
    const auto x = static_cast<int>(pixel % picture.width), y = static_cast<int>(pixel / picture.width);
    for (int v = std::max(0, y - kMarkReach); v <= std::min(y + kMarkReach, static_cast<int>(picture.height) - 1); ++v)
        for (int u = std::max(0, x - kMarkReach); u <= std::min(x + kMarkReach, static_cast<int>(picture.width) - 1); ++u)
            std::ranges::copy(kMark, picture.pixels.begin() + 4 * (v * static_cast<std::ptrdiff_t>(picture.width) + u));
}

Marked markedDifference(const Picture& a, const Picture& b) {
    Marked marked{faded(b), 0};
    const size_t pixels = b.pixels.size() / 4;
    size_t differing = 0;
    for (size_t p = 0; p < pixels; ++p)
        if (differAt(a, b, p)) {
            mark(marked.picture, p);
            ++differing;
        }
    marked.share = static_cast<double>(differing) / static_cast<double>(pixels);
    return marked;
}

struct Extremes {
    const Measurement *cheapest, *dearest;
};

// nullptr where there is but one that came to an end.
Extremes extremesOf(const Results& results, const std::string& workload) {
    Extremes extremes = {nullptr, nullptr};
    for (const Measurement& m : results.measurements) {
        if (m.workload != workload || !m.failed.empty()) continue;
        if (extremes.cheapest == nullptr || m.ms.median < extremes.cheapest->ms.median) extremes.cheapest = &m;
        if (extremes.dearest == nullptr || m.ms.median > extremes.dearest->ms.median) extremes.dearest = &m;
    }
    return extremes;
}

std::string nameOf(const Measurement& m) { return m.is_default ? "default" : m.knob + " " + m.setting; }

template <class Setting>
const Setting& settingOf(std::span<const Setting> settings, const Measurement& m) {
    return *std::ranges::find_if(settings, [&](const Setting& s) { return s.knob == m.knob && s.setting == m.setting; });
}

Result<Picture> drawnBreak(Sweep& sweep, const brittle::PreparedMesh& model, const Measurement& m) {
    brittle::FractureOptions options;
    settingOf(fractureSettings(), m).apply(options);
    const auto fracture = brittle::Fracture::create(sweep.device, sweep.options.group_size);
    if (!fracture) return fracture.error();
    const auto result = (*fracture)->shatter(model.mesh, model.topology, options);
    if (!result) return result.error();
    return cli::pictureOf(sweep.device, result->fragments, kExplode, kSize);
}

Result<Picture> drawnPile(Sweep& sweep, const std::string& name, const Measurement& m) {
    auto scene = brittle::makeBuiltinScene(name);
    if (!scene) return scene.error();
    scene->camera.width = kSize.width;
    scene->camera.height = kSize.height;
    brittle::WorldSurfaces surfaces;
    const auto contents = brittle::contentsOf(*scene, ".", nullptr, &surfaces);
    if (!contents) return contents.error();
    auto settings = brittle::settingsOf(*scene);
    if (!settings) return settings.error();
    settingOf(dynamicsSettings(), m).apply(*settings);
    const auto world = brittle::World::create(sweep.device, *contents, *settings, brittle::budgetOf(*scene));
    if (!world) return world.error();
    if (auto done = (*world)->step(static_cast<uint32_t>(std::lround(kSeconds / settings->dt))); !done) return done.error();
    const auto bodies = (*world)->bodies();
    if (!bodies) return bodies.error();
    brittle::Poses poses;
    for (const gpu::BodyState& body : *bodies)
        poses.emplace_back(brittle::poseOf(body));
    const auto drawing = cli::WorldPicture::create({sweep.device, *scene, surfaces, brittle::originOf(contents->bodies)});
    if (!drawing) return drawing.error();
    return (*drawing)->draw({poses, {}});
}

// Where the device cannot draw, the page goes without.
void addPair(Results& results, const Extremes& extremes, const Result<Picture>& cheap, const Result<Picture>& dear,
             const char* title, const char* caption) {
    if (!cheap || !dear) return;
    const Marked marked = markedDifference(*cheap, *dear);
    results.pictures.push_back({title, nameOf(*extremes.cheapest), nameOf(*extremes.dearest), caption,
                                extremes.cheapest->ms.median, extremes.dearest->ms.median, marked.share, dataUri(*cheap),
                                dataUri(*dear), dataUri(marked.picture)});
}

} // namespace

Result<void> drawPairs(Sweep& sweep) {
    if (!sweep.device.hasGraphics()) return {};
    const auto model = soundModel("builtin:bumpy:5");
    if (!model) return model.error();
    const Extremes of_break = extremesOf(sweep.results, "bumpy_20480");
    addPair(sweep.results, of_break, drawnBreak(sweep, *model, *of_break.cheapest),
            drawnBreak(sweep, *model, *of_break.dearest), "A break",
            "100 cells of the ball with bumps and hollows, pulled apart.");
    sweep.progress.show("a pile", 0.4);
    const Extremes of_pile = extremesOf(sweep.results, "pile");
    addPair(sweep.results, of_pile, drawnPile(sweep, "hull_pile_100", *of_pile.cheapest),
            drawnPile(sweep, "hull_pile_100", *of_pile.dearest), "A pile", "100 hulls, after 3 seconds.");
    return {};
}

} // namespace accuracy
