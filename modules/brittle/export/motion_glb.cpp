#include "modules/brittle/export/motion_glb.h"

#include "modules/brittle/export/gltf_writer.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numbers>

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
            std::span<const Place> places, std::span<const Rotation> turns)
        : surfaces_(surfaces), camera_(camera), origin_(origin), times_(times), places_(places), turns_(turns) {}
    engine::Result<std::string> run();

private:
    void addWorld();
    void addBody(size_t body);
    int meshOf(const BodyLook& look);
    void addCamera();
    int addChild(const std::string& name);
    void addMotion(size_t body, int node);
    template <size_t width>
    void addChannel(int node, const char* path, GltfWriter::View view, size_t body,
                    std::span<const std::array<float, width>> keys);

    const WorldSurfaces& surfaces_;
    const CameraDescription& camera_;
    const Double3& origin_;
    std::span<const float> times_;
    std::span<const Place> places_;
    std::span<const Rotation> turns_;
    GltfWriter writer_;
    tinygltf::Model& model_ = writer_.model();
    tinygltf::Animation motion_;
    int outer_ = 0, inner_ = 0, still_ = 0, input_ = -1;
    std::vector<std::array<int, 2>> meshes_; // by surface: of what is still, of what moves; -1 where there is none yet
};

engine::Result<std::string> Encoder::run() {
    outer_ = writer_.addMaterial("outer", kOuterColor);
    inner_ = writer_.addMaterial("inner", kInnerColor);
    still_ = writer_.addMaterial("still", {0.42, 0.44, 0.47});
    meshes_.resize(surfaces_.meshes.size(), {-1, -1});
    addWorld();
    for (size_t body = 0; body < surfaces_.bodies.size(); ++body)
        addBody(body);
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

void Encoder::addBody(size_t body) {
    const BodyLook& look = surfaces_.bodies[body];
    const int index = addChild(look.name);
    tinygltf::Node& node = model_.nodes.back();
    node.mesh = meshOf(look);
    node.translation.assign(places_[body].begin(), places_[body].end());
    node.rotation.assign(turns_[body].begin(), turns_[body].end());
    if (look.moves) addMotion(body, index);
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

void Encoder::addMotion(size_t body, int node) {
    const size_t bodies = surfaces_.bodies.size();
    bool moved = false;
    for (size_t at = body; at < places_.size(); at += bodies)
        moved = moved || places_[at] != places_[body] || turns_[at] != turns_[body];
    if (!moved) return;
    if (input_ < 0) input_ = writer_.addNumbers(GltfWriter::kTimes, times_, 1);
    addChannel(node, "translation", GltfWriter::kPlaces, body, places_);
    addChannel(node, "rotation", GltfWriter::kTurns, body, turns_);
}

template <size_t width>
void Encoder::addChannel(int node, const char* path, GltfWriter::View view, size_t body,
                         std::span<const std::array<float, width>> keys) {
    std::vector<float> numbers;
    for (size_t at = body; at < keys.size(); at += surfaces_.bodies.size())
        numbers.insert(numbers.end(), keys[at].begin(), keys[at].end());
    tinygltf::AnimationSampler& sampler = motion_.samplers.emplace_back();
    sampler.input = input_;
    sampler.output = writer_.addNumbers(view, numbers, static_cast<int>(width));
    sampler.interpolation = "LINEAR";
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

engine::Result<void> MotionGlb::add(double time, std::span<const Pose> poses) {
    const auto at = static_cast<float>(time);
    if (!times_.empty() && at <= times_.back())
        return engine::Error{engine::ErrorCode::BadInput, "the frames at " + std::to_string(time) +
                                                              " s are too close for the file's floats; ask for fewer a second"};
    const size_t bodies = surfaces_.bodies.size();
    if ((places_.size() + bodies) * (sizeof(Place) + sizeof(Rotation)) > kMaxGlbBytes)
        return engine::Error{engine::ErrorCode::Capacity,
                             "the motion exceeds the 4 GiB of a GLB file; ask for fewer seconds or frames a second"};
    for (size_t body = 0; body < bodies; ++body) {
        const Rotation* last = times_.empty() ? nullptr : &turns_[turns_.size() - bodies];
        const Rotation turn = nearTo(last, poses[body].turn);
        places_.push_back(toFloat(poses[body].place - origin_));
        turns_.push_back(turn);
    }
    times_.push_back(at);
    return {};
}

engine::Result<std::string> MotionGlb::encode() const {
    if (times_.empty()) return engine::Error{engine::ErrorCode::Internal, "no motion to write"};
    return Encoder(surfaces_, camera_, origin_, times_, places_, turns_).run();
}

} // namespace brittle
