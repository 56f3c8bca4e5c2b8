#include "tools/brittle/shatter.h"

#include "modules/brittle/collision/collider_mesh.h"
#include "modules/brittle/export/glb.h"
#include "modules/brittle/mesh/folds.h"
#include "modules/brittle/mesh/format.h"
#include "tools/brittle/drop.h"
#include "tools/brittle/interrupt.h"
#include "tools/brittle/model.h"
#include "tools/brittle/picture.h"
#include "tools/brittle/progress.h"
#include "tools/brittle/same_file.h"
#include "tools/brittle/scene_files.h"
#include "tools/brittle/sites_file.h"

#include <chrono>
#include <optional>

namespace cli {
namespace {

using Clock = std::chrono::steady_clock;

// Of volume over area times size, for a plate or rod of a hundredth: below, rounding of corners shows in the volume.
constexpr double kThin = 4e-3;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// The steps of one run, in order. Each takes what it needs from those before it and stops the run where it fails.
class Run {
public:
    explicit Run(const ShatterOptions& options) : options_(options) {}
    engine::Result<void> all(const TellOutcome& tell);

private:
    engine::Result<void> checkPathsApart() const;
    engine::Result<void> openOutputs();
    engine::Result<void> openMotion();
    engine::Result<void> readModel();
    engine::Result<void> checkModel();
    engine::Result<void> readSites();
    engine::Result<void> openDevice();
    engine::Result<void> breakModel();
    engine::Result<brittle::FractureResult> breakAsWished(brittle::Fracture& fracture, const brittle::FractureOptions& usual);
    std::string violationOf(const brittle::FractureResult& result) const;
    engine::Result<void> verify();
    engine::Error brokenContract(const std::string& violation) const;
    engine::Result<void> writeFragments();
    engine::Result<void> dropFragments();
    engine::Result<void> writePicture();
    engine::Result<void> commitOutputs();
    engine::Error aboutModel(const engine::Error& error) const { return {error.code, options_.model + ": " + error.message}; }

    const ShatterOptions& options_;
    ShatterOutcome outcome_;
    std::unique_ptr<engine::Device> device_; // outlives what draws with it
    std::optional<brittle::OutputFile> output_, picture_, collider_picture_;
    std::unique_ptr<MotionOutput> motion_; // instead of `output_`
    std::optional<brittle::PreparedMesh> model_;
    std::vector<brittle::Double3> given_sites_;
};

engine::Result<void> Run::all(const TellOutcome& tell) {
    struct Step {
        const char* name;     // in the list of times
        const char* progress; // nullptr for what takes no time
        engine::Result<void> (Run::*run)();
    };
    static constexpr Step kSteps[] = {
        {"open", nullptr, &Run::openOutputs},
        {"sites", nullptr, &Run::readSites},
        {"import", "reading the model", &Run::readModel},
        {"check", "checking the model", &Run::checkModel},
        {"device", "opening the device", &Run::openDevice},
        {"fracture", "breaking", &Run::breakModel},
        {"verify", "verifying", &Run::verify},
        {"export", "writing", &Run::writeFragments},
        {"picture", "drawing", &Run::writePicture},
    };
    const Clock::time_point start = Clock::now();
    for (const Step& step : kSteps) {
        if (step.progress) showProgress(step.progress);
        const Clock::time_point began = Clock::now();
        if (auto done = (this->*step.run)(); !done) return done.error();
        if (step.progress) outcome_.ms.emplace_back(step.name, millisecondsSince(began));
    }
    clearProgress();
    outcome_.total_ms = millisecondsSince(start);
    if (auto told = tell(outcome_); !told) return told;
    return commitOutputs();
}

// A name without any ending is whatever is written to it.
bool mayEndIn(const std::string& path, const std::string& wanted) {
    const std::string ending = endingOf(path);
    return ending.empty() || ending == wanted;
}

engine::Result<void> Run::checkPathsApart() const {
    const auto refused = [](const std::string& path, const std::string& why) {
        return engine::Error{engine::ErrorCode::BadInput, path + ": " + why};
    };
    const std::string &picture = options_.picture, &of_colliders = options_.collider_picture;
    const std::string ending = endingOf(options_.output);
    if (!options_.drop && (ending == ".png" || ending == ".mp4"))
        return refused(options_.output, "fragments are written as a GLB file; --picture draws them, --drop lets them fall");
    if (sameFile(picture, options_.output) || sameFile(of_colliders, options_.output))
        return refused(options_.output, "fragments and picture need a file each");
    if (!of_colliders.empty() && options_.collider == 0)
        return refused(of_colliders, "there are no colliders to draw; ask for them, with --collider 26 say");
    if (sameFile(picture, of_colliders)) return refused(picture, "the two pictures need a file each");
    std::vector<std::filesystem::path> inputs = filesOfModel(options_.model);
    inputs.emplace_back(options_.sites_file);
    for (const std::string& output : {options_.output, picture, of_colliders})
        if (auto apart = checkIsNoInput(output, inputs); !apart) return apart.error();
    if (!options_.drop && !mayEndIn(options_.output, ".glb"))
        return refused(options_.output, "fragments are written as a GLB file; let its name end in .glb");
    for (const std::string& drawn : {picture, of_colliders})
        if (!mayEndIn(drawn, ".png")) return refused(drawn, "pictures are PNG files; let its name end in .png");
    return {};
}

engine::Result<void> Run::openOutputs() {
    const auto open = [](const std::string& path, std::optional<brittle::OutputFile>& file) -> engine::Result<void> {
        auto created = createOutput(path);
        if (!created) return created.error();
        file.emplace(std::move(*created));
        return {};
    };
    if (auto apart = checkPathsApart(); !apart) return apart.error();
    if (auto opened = options_.drop ? openMotion() : open(options_.output, output_); !opened) return opened.error();
    if (!options_.picture.empty())
        if (auto opened = open(options_.picture, picture_); !opened) return opened.error();
    if (options_.collider_picture.empty()) return {};
    return open(options_.collider_picture, collider_picture_);
}

engine::Result<void> Run::openMotion() {
    auto motion = MotionOutput::create(options_.output, options_.drop->fps);
    if (!motion) return motion.error();
    motion_ = std::move(*motion);
    return {};
}

engine::Result<void> Run::readModel() {
    auto model = loadModel(options_.model, options_.repair);
    if (!model) return model.error();
    model_.emplace(std::move(model->model));
    outcome_.mended = std::move(model->notes);
    return {};
}

engine::Result<void> Run::checkModel() {
    brittle::MeshReport report = brittle::inspectMesh(model_->mesh, model_->topology);
    if (!report.isSound()) return aboutModel({engine::ErrorCode::BadInput, report.problems.front() + adviceToRepair(report)});
    outcome_.model = std::move(report);
    return {};
}

engine::Result<void> Run::readSites() {
    if (options_.sites_file.empty()) return {};
    auto sites = readSitesFile(options_.sites_file);
    if (!sites) return sites.error();
    given_sites_ = std::move(*sites);
    return {};
}

engine::Result<void> Run::openDevice() {
    auto device = engine::Device::create({.select = options_.device});
    if (!device) return device.error();
    device_ = std::move(*device);
    outcome_.device = device_->name();
    return {};
}

engine::Result<void> Run::breakModel() {
    brittle::FractureOptions options;
    options.site_count = options_.sites;
    options.seed = options_.seed;
    options.given_sites = given_sites_;
    options.search = options_.search;
    options.caps = options_.caps;
    options.cells = options_.cells;
    options.precision = options_.precision;
    options.pattern = options_.pattern;
    options.relax = options_.relax;
    options.collider = options_.collider;
    options.impact = {options_.at.value_or(model_->mesh.center), brittle::contactRadiusOf(options_.strength),
                      brittle::favorOf(options_.strength), options_.candidates};
    auto fracture = brittle::Fracture::create(*device_, options_.group_size);
    if (!fracture) return fracture.error();
    auto result = options_.wish.isThere() ? breakAsWished(**fracture, options)
                                          : (*fracture)->shatter(model_->mesh, model_->topology, options);
    if (!result) return aboutModel(result.error());
    outcome_.result = std::move(*result);
    outcome_.ms.emplace_back("setup", outcome_.result.setup_ms);
    for (const engine::Timing& timing : outcome_.result.timings)
        outcome_.ms.emplace_back(timing.name, timing.ms);
    return {};
}

std::string Run::violationOf(const brittle::FractureResult& result) const {
    return brittle::verifyContract(model_->mesh, outcome_.model.measures, result.fragments, result.sites).violation();
}

// Breaks it as usual first, twice, since drivers compile kernels in the first: prices tell how times compare, not how long this
// model takes. What is picked may do for other models and not for this one; then the usual fragments are kept.
engine::Result<brittle::FractureResult> Run::breakAsWished(brittle::Fracture& fracture, const brittle::FractureOptions& usual) {
    const auto shatter = [&](const brittle::FractureOptions& options) {
        return fracture.shatter(model_->mesh, model_->topology, options);
    };
    if (auto first = shatter(usual); !first) return first;
    auto result = shatter(usual);
    if (!result) return result;
    auto picked = pickSetting(*device_, accuracy::kFractureFamily, result->total_ms, options_.wish);
    if (!picked) return picked.error();
    brittle::FractureOptions options = usual;
    applyTo(options, picked->choice.price);
    if (picked->choice.price.knob != "default") {
        if (auto first = shatter(options); !first) picked->fell_back = first.error().message;
        auto other = picked->fell_back.empty() ? shatter(options) : result;
        if (picked->fell_back.empty()) picked->fell_back = other ? violationOf(*other) : other.error().message;
        if (picked->fell_back.empty()) result = std::move(other);
    }
    picked->taken_ms = result->total_ms;
    outcome_.picked = std::move(*picked);
    return result;
}

// Where an option asked for less than what is always right, or the model for more than floats can hold, that is what to change.
engine::Error Run::brokenContract(const std::string& violation) const {
    const brittle::MeshMeasures& m = outcome_.model.measures;
    const bool rounded = options_.precision != brittle::Precision::Exact, convex = options_.caps == brittle::Caps::Convex;
    const auto folds = brittle::findFolds(model_->mesh, model_->topology, brittle::kTouchDepth * m.diagonal);
    std::string advice = "move the sites a little, and please report it";
    if (m.volume < kThin * m.area * m.diagonal)
        advice = "a model as thin as this must lie along the axes, for floats to hold it";
    if (!folds.empty())
        advice =
            "at " + brittle::formatCount(static_cast<uint64_t>(folds.size()), "edge") +
            " a face of the model lies on its neighbor (`brittle doctor` has the places): cut these faces into triangles again";
    if (convex) advice = "the model is not convex where it was cut: use --caps exact";
    if (rounded) advice = convex ? "use --precision exact and --caps exact" : "use --precision exact";
    return {rounded || convex || !folds.empty() ? engine::ErrorCode::BadInput : engine::ErrorCode::Internal,
            "the fragments break their contract: " + violation + "; nothing was written; " + advice};
}

// Always: a wrong result is no result. --verify says in words what was found.
engine::Result<void> Run::verify() {
    const brittle::FractureResult& result = outcome_.result;
    outcome_.contract = brittle::verifyContract(model_->mesh, outcome_.model.measures, result.fragments, result.sites);
    const std::string violation = outcome_.contract.violation();
    if (violation.empty()) return {};
    return aboutModel(brokenContract(violation));
}

engine::Result<void> Run::dropFragments() {
    const brittle::FragmentSet& fragments = outcome_.result.fragments;
    StagedScene staged;
    staged.scene = dropScene(options_.model, fragments, options_.drop->height);
    staged.room_advice = "here: use fewer sites";
    auto contents = brittle::contentsOfBroken(staged.scene, fragments, &staged.surfaces);
    if (!contents) return aboutModel(contents.error());
    staged.contents = std::move(*contents);
    auto report = simulate(*device_, staged, options_.drop->seconds, options_.group_size, motion_.get());
    if (!report) return report.error();
    outcome_.motion = std::move(*report);
    return {};
}

engine::Result<void> Run::writeFragments() {
    if (options_.drop) return dropFragments();
    const auto bytes = brittle::encodeGlb(outcome_.result.fragments);
    if (!bytes) return bytes.error();
    return output_->write(*bytes);
}

engine::Result<void> Run::writePicture() {
    const brittle::FragmentSet& fragments = outcome_.result.fragments;
    if (picture_)
        if (auto drawn = drawFragments(*device_, fragments, options_.explode, picture_->temporaryPath()); !drawn)
            return drawn.error();
    if (!collider_picture_) return {};
    const brittle::FragmentSet colliders = brittle::meshesOfColliders(fragments);
    return drawFragments(*device_, colliders, options_.explode, collider_picture_->temporaryPath());
}

engine::Result<void> Run::commitOutputs() {
    for (auto* picture : {&picture_, &collider_picture_})
        if (*picture)
            if (auto committed = (*picture)->commit(); !committed) return committed.error();
    return motion_ ? motion_->commit() : output_->commit();
}

} // namespace

engine::Result<void> shatter(const ShatterOptions& options, const TellOutcome& tell) { return Run(options).all(tell); }

} // namespace cli
