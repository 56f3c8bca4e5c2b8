#include "modules/brittle/export/motion_glb.h"

#include "modules/brittle/export/gltf_writer.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>
#include <numbers>
#include <utility>

namespace brittle {
namespace {

using Place = std::array<float, 3>;
using Rotation = std::array<float, 4>;

// Continuous: q and -q are one turn, but what lies between two of them is not.
Rotation nearTo(const Rotation* last, const Turn& turn) {
    double along = 1;
    if (last != nullptr) {
        along = 0;
        for (size_t k = 0; k < 4; ++k)
            along += double{(*last)[k]} * turn[k];
    }
    Rotation near;
    for (size_t k = 0; k < 4; ++k)
        near[k] = static_cast<float>(along < 0 ? -turn[k] : turn[k]);
    return near;
}

// The axes of a camera's frame: to the right, up, back to where it stands.
Turn lookingAlong(const CameraDescription& camera) {
    const auto vector = [](const Double3& v) { return Eigen::Vector3d(v[0], v[1], v[2]); };
    const Eigen::Vector3d back = vector(camera.eye - camera.target).normalized();
    const Eigen::Vector3d right = vector(camera.up).cross(back).normalized();
    Eigen::Matrix3d axes;
    axes << right, back.cross(right), back;
    const Eigen::Quaterniond q(axes);
    return {q.x(), q.y(), q.z(), q.w()};
}

class Encoder {
public:
    Encoder(const WorldSurfaces& surfaces, const CameraDescription& camera, const Double3& origin, std::span<const float> times,
            std::span<const BodyTrack> tracks)
        : surfaces_(surfaces), camera_(camera), origin_(origin), times_(times), tracks_(tracks) {}
    engine::Result<std::string> run();

private:
    void addWorld();
    void addBody(const BodyLook& look, const BodyTrack& track);
    int meshOf(const BodyLook& look);
    void addCamera();
    int addChild(const std::string& name);
    void addMotion(const BodyTrack& track, int node);
    int timesOf(const BodyTrack& track);
    // Of what is not there all the time.
    void addVisits(const BodyTrack& track, int node);
    std::array<int, 2> visitsOf(const BodyTrack& track); // times and scales
    std::array<int, 2> scalesOf(const BodyTrack& track, size_t keys);
    template <size_t width>
    int addKeys(GltfWriter::View view, std::span<const std::array<float, width>> keys);
    void addChannel(int node, const char* path, std::array<int, 2> keys, const char* interpolation);

    const WorldSurfaces& surfaces_;
    const CameraDescription& camera_;
    const Double3& origin_;
    std::span<const float> times_;
    std::span<const BodyTrack> tracks_;
    GltfWriter writer_;
    tinygltf::Model& model_ = writer_.model();
    tinygltf::Animation motion_;
    int outer_ = 0, inner_ = 0, still_ = 0;
    using Stay = std::pair<size_t, size_t>;
    std::map<Stay, int> times_of_;
    std::map<Stay, std::array<int, 2>> visits_of_;
    std::vector<std::array<int, 2>> meshes_; // by surface: of what is still, of what moves; -1 where there is none yet
};

engine::Result<std::string> Encoder::run() {
    outer_ = writer_.addMaterial("outer", kOuterColor);
    inner_ = writer_.addMaterial("inner", kInnerColor);
    still_ = writer_.addMaterial("still", {0.42, 0.44, 0.47});
    meshes_.resize(surfaces_.meshes.size(), {-1, -1});
    addWorld();
    for (size_t body = 0; body < tracks_.size(); ++body)
        if (!tracks_[body].places.empty()) addBody(surfaces_.bodies[body], tracks_[body]);
    addCamera();
    motion_.name = "motion";
    if (!motion_.channels.empty()) model_.animations.push_back(std::move(motion_));
    return writer_.finish("the bodies and their motion", "ask for fewer seconds or frames a second");
}

void Encoder::addWorld() {
    tinygltf::Node& world = model_.nodes.emplace_back();
    world.name = "world";
    world.translation.assign(origin_.begin(), origin_.end());
    model_.scenes[0].nodes.push_back(0);
}

int Encoder::addChild(const std::string& name) {
    const auto index = static_cast<int>(model_.nodes.size());
    model_.nodes.emplace_back().name = name;
    model_.nodes[0].children.push_back(index);
    return index;
}

void Encoder::addBody(const BodyLook& look, const BodyTrack& track) {
    const int index = addChild(look.name);
    tinygltf::Node& node = model_.nodes.back();
    node.mesh = meshOf(look);
    node.translation.assign(track.places[0].begin(), track.places[0].end());
    node.rotation.assign(track.turns[0].begin(), track.turns[0].end());
    if (track.first > 0) node.scale = {0, 0, 0};
    if (look.moves) addMotion(track, index);
    addVisits(track, index);
}

int Encoder::meshOf(const BodyLook& look) {
    int& index = meshes_[look.mesh][look.moves ? 1 : 0];
    if (index >= 0) return index;
    index = static_cast<int>(model_.meshes.size());
    tinygltf::Mesh& mesh = model_.meshes.emplace_back();
    mesh.name = look.name;
    const SurfaceMesh& surface = surfaces_.meshes[look.mesh];
    const std::span indices = surface.indices;
    const auto add = [&](std::span<const uint32_t> part, int material) {
        if (!part.empty()) mesh.primitives.push_back(writer_.addPrimitive(cornersOf(surface.vertices, part), material));
    };
    add(indices.first(surface.outer_index_count), look.moves ? outer_ : still_);
    add(indices.subspan(surface.outer_index_count), inner_);
    return index;
}

void Encoder::addMotion(const BodyTrack& track, int node) {
    const auto stays = [](const auto& keys) {
        return std::ranges::all_of(keys, [&](const auto& key) { return key == keys[0]; });
    };
    if (stays(track.places) && stays(track.turns)) return;
    const int times = timesOf(track);
    addChannel(node, "translation", {times, addKeys<3>(GltfWriter::kPlaces, track.places)}, "LINEAR");
    addChannel(node, "rotation", {times, addKeys<4>(GltfWriter::kTurns, track.turns)}, "LINEAR");
}

int Encoder::timesOf(const BodyTrack& track) {
    const auto [entry, is_new] = times_of_.try_emplace({track.first, track.end()});
    if (is_new) entry->second = writer_.addNumbers(GltfWriter::kTimes, times_.subspan(track.first, track.places.size()), 1);
    return entry->second;
}

void Encoder::addVisits(const BodyTrack& track, int node) {
    const bool fades = std::ranges::any_of(track.scales, [](float scale) { return scale != 1; });
    const bool visits = track.first > 0 || track.end() < times_.size();
    if (fades)
        addChannel(node, "scale", scalesOf(track, track.scales.size()), "STEP");
    else if (visits)
        addChannel(node, "scale", visitsOf(track), "STEP");
}

std::array<int, 2> Encoder::visitsOf(const BodyTrack& track) {
    const auto [entry, is_new] = visits_of_.try_emplace({track.first, track.end()});
    if (is_new) entry->second = scalesOf(track, 1);
    return entry->second;
}

// Of the first so many times that it is there.
std::array<int, 2> Encoder::scalesOf(const BodyTrack& track, size_t keys) {
    std::vector<float> times;
    std::vector<Place> scales;
    const auto add = [&](size_t at, float scale) {
        times.push_back(times_[at]);
        scales.push_back({scale, scale, scale});
    };
    if (track.first > 0) add(0, 0);
    for (size_t k = 0; k < keys; ++k)
        add(track.first + k, track.scales[k]);
    if (track.end() < times_.size()) add(track.end(), 0);
    return {writer_.addNumbers(GltfWriter::kTimes, times, 1), addKeys<3>(GltfWriter::kScales, scales)};
}

template <size_t width>
int Encoder::addKeys(GltfWriter::View view, std::span<const std::array<float, width>> keys) {
    std::vector<float> numbers;
    for (const auto& key : keys)
        numbers.insert(numbers.end(), key.begin(), key.end());
    return writer_.addNumbers(view, numbers, static_cast<int>(width));
}

void Encoder::addChannel(int node, const char* path, std::array<int, 2> keys, const char* interpolation) {
    tinygltf::AnimationSampler& sampler = motion_.samplers.emplace_back();
    sampler.input = keys[0];
    sampler.output = keys[1];
    sampler.interpolation = interpolation;
    tinygltf::AnimationChannel& channel = motion_.channels.emplace_back();
    channel.sampler = static_cast<int>(motion_.samplers.size() - 1);
    channel.target_node = node;
    channel.target_path = path;
}

void Encoder::addCamera() {
    tinygltf::Camera& camera = model_.cameras.emplace_back();
    camera.type = "perspective";
    camera.name = "camera";
    const double distance = length(camera_.eye - camera_.target);
    camera.perspective.yfov = camera_.field_of_view * std::numbers::pi / 180;
    camera.perspective.aspectRatio = static_cast<double>(camera_.width) / camera_.height;
    camera.perspective.znear = 0.01 * distance;
    camera.perspective.zfar = 1000 * distance;
    addChild("camera");
    tinygltf::Node& node = model_.nodes.back();
    const Double3 eye = camera_.eye - origin_;
    const Turn turn = lookingAlong(camera_);
    node.translation.assign(eye.begin(), eye.end());
    node.rotation.assign(turn.begin(), turn.end());
    node.camera = 0;
}

} // namespace

engine::Result<void> MotionGlb::add(double time, const Poses& poses) {
    const auto at = static_cast<float>(time);
    if (!times_.empty() && at <= times_.back())
        return engine::Error{engine::ErrorCode::BadInput, "the frames at " + std::to_string(time) +
                                                              " s are too close for the file's floats; ask for fewer a second"};
    const auto there = static_cast<size_t>(std::ranges::count_if(poses, [](const auto& pose) { return pose.has_value(); }));
    if ((keys_ + there) * (sizeof(Place) + sizeof(Rotation)) > kMaxGlbBytes)
        return engine::Error{engine::ErrorCode::Capacity,
                             "the motion exceeds the 4 GiB of a GLB file; ask for fewer seconds or frames a second"};
    tracks_.resize(std::max(tracks_.size(), poses.size()));
    for (size_t body = 0; body < poses.size(); ++body)
        if (poses[body]) addKey(tracks_[body], *poses[body]);
    times_.push_back(at);
    return {};
}

void MotionGlb::addKey(BodyTrack& track, const Pose& pose) {
    if (track.places.empty()) track.first = times_.size();
    const Rotation turn = nearTo(track.turns.empty() ? nullptr : &track.turns.back(), pose.turn);
    track.places.push_back(toFloat(pose.place - origin_));
    track.turns.push_back(turn);
    track.scales.push_back(static_cast<float>(pose.scale));
    ++keys_;
}

engine::Result<std::string> MotionGlb::encode() const {
    if (times_.empty()) return engine::Error{engine::ErrorCode::Internal, "no motion to write"};
    return Encoder(surfaces_, camera_, origin_, times_, tracks_).run();
}

} // namespace brittle
