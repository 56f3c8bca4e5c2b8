#include "tools/brittle/motion_output.h"

#include "modules/brittle/export/motion_glb.h"
#include "tools/brittle/film.h"
#include "tools/brittle/frame_times.h"
#include "tools/brittle/interrupt.h"
#include "tools/brittle/numbered_name.h"
#include "tools/brittle/world_picture.h"

#include <algorithm>
#include <filesystem>
#include <optional>

namespace cli {
namespace {

using brittle::OutputFile;
using engine::Result;

class GlbOutput : public MotionOutput {
public:
    GlbOutput(OutputFile file, double fps) : file_(std::move(file)), fps_(fps) {}
    Result<std::vector<double>> times(double seconds) const override { return frameTimesAndEnd(seconds, fps_); }
    Result<void> begin(const Spectacle& s) override {
        motion_.emplace(s.surfaces, s.scene.camera, s.origin);
        return {};
    }
    // Dust is left out: it would be a node for every particle.
    Result<void> add(double time, const Moment& moment) override { return motion_->add(time, moment.poses); }
    Result<void> finish() override {
        const auto bytes = motion_->encode();
        if (!bytes) return bytes.error();
        return file_.write(*bytes);
    }
    Result<void> commit() override { return file_.commit(); }

private:
    OutputFile file_;
    double fps_;
    std::optional<brittle::MotionGlb> motion_;
};

// The last moment.
class PictureOutput : public MotionOutput {
public:
    explicit PictureOutput(OutputFile file) : file_(std::move(file)) {}
    Result<std::vector<double>> times(double seconds) const override { return std::vector{seconds}; }
    Result<void> begin(const Spectacle& s) override { return open(s, world_); }
    Result<void> add(double, const Moment& moment) override {
        const auto picture = world_->draw(moment);
        if (!picture) return picture.error();
        return engine::writePng(*picture, file_.temporaryPath().string());
    }
    Result<void> finish() override { return {}; }
    Result<void> commit() override { return file_.commit(); }

    static Result<void> open(const Spectacle& s, std::unique_ptr<WorldPicture>& world) {
        auto made = WorldPicture::create(s);
        if (!made) return made.error();
        world = std::move(*made);
        return {};
    }

private:
    OutputFile file_;
    std::unique_ptr<WorldPicture> world_;
};

class PicturesOutput : public MotionOutput {
public:
    PicturesOutput(NumberedName name, double fps) : name_(std::move(name)), fps_(fps) {}
    Result<std::vector<double>> times(double seconds) const override { return frameTimes(seconds, fps_); }
    Result<void> begin(const Spectacle& s) override { return PictureOutput::open(s, world_); }
    Result<void> add(double, const Moment& moment) override {
        auto file = createOutput(name_.of(files_.size()));
        if (!file) return file.error();
        files_.push_back(std::move(*file));
        const auto picture = world_->draw(moment);
        if (!picture) return picture.error();
        return engine::writePng(*picture, files_.back().temporaryPath().string());
    }
    Result<void> finish() override { return {}; }
    Result<void> commit() override {
        for (OutputFile& file : files_)
            if (auto done = file.commit(); !done) return done;
        return {};
    }

private:
    NumberedName name_;
    double fps_;
    std::vector<OutputFile> files_;
    std::unique_ptr<WorldPicture> world_;
};

class FilmOutput : public MotionOutput {
public:
    FilmOutput(OutputFile file, double fps) : file_(std::move(file)), fps_(fps) {}
    Result<std::vector<double>> times(double seconds) const override { return frameTimes(seconds, fps_); }
    Result<void> begin(const Spectacle& s) override {
        if (auto opened = PictureOutput::open(s, world_); !opened) return opened;
        auto film = Film::start(file_.temporaryPath().string(), s.scene.camera.width, s.scene.camera.height, fps_);
        if (!film) return film.error();
        film_ = std::move(*film);
        return {};
    }
    Result<void> add(double, const Moment& moment) override {
        const auto picture = world_->draw(moment);
        if (!picture) return picture.error();
        return film_->add(*picture);
    }
    Result<void> finish() override { return film_->finish(); }
    Result<void> commit() override { return file_.commit(); }

private:
    OutputFile file_;
    double fps_;
    std::unique_ptr<WorldPicture> world_;
    std::unique_ptr<Film> film_; // ends before its file is removed
};

template <class Output, class... More>
Result<std::unique_ptr<MotionOutput>> openOutput(const std::string& path, More... more) {
    auto file = createOutput(path);
    if (!file) return file.error();
    return std::unique_ptr<MotionOutput>(std::make_unique<Output>(std::move(*file), more...));
}

Result<std::unique_ptr<MotionOutput>> openNumbered(const NumberedName& name, double fps) {
    // Whether the first could be written; it is removed again at once.
    if (auto probe = createOutput(name.of(0)); !probe) return probe.error();
    return std::unique_ptr<MotionOutput>(std::make_unique<PicturesOutput>(name, fps));
}

} // namespace

std::string endingOf(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

Result<std::unique_ptr<MotionOutput>> MotionOutput::create(const std::string& path, double fps) {
    const std::string ending = endingOf(path);
    const auto numbered = NumberedName::parse(path);
    if (numbered && ending != ".png")
        return engine::Error{engine::ErrorCode::BadInput, path + ": only pictures are numbered, and end in .png"};
    if (!numbered && ending == ".png" && std::filesystem::path(path).filename().string().find('%') != std::string::npos)
        return engine::Error{engine::ErrorCode::BadInput,
                             path + ": a '%' in the name of a picture stands for its number; write %d or %04d, once"};
    if (ending == ".glb") return openOutput<GlbOutput>(path, fps);
    if (ending == ".png") return numbered ? openNumbered(*numbered, fps) : openOutput<PictureOutput>(path);
    if (ending == ".mp4") {
        if (auto there = Film::isPossible(); !there) return there.error();
        return openOutput<FilmOutput>(path, fps);
    }
    return engine::Error{engine::ErrorCode::BadInput,
                         path + ": its ending is none of .glb, .png and .mp4; give it one of these"};
}

} // namespace cli
