#include "tools/brittle/world_picture.h"

#include "engine/renderer.h"
#include "modules/brittle/mesh/vector_math.h"
#include "tools/brittle/drawn_buffer.h"
#include "tools/brittle/shown_colors.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>
#include <numbers>
#include <optional>
#include <unordered_map>

namespace cli {
namespace {

using brittle::Double3;
using brittle::Pose;
using brittle::Poses;
using brittle::operator-; // of arrays, which argument-dependent lookup does not find
using engine::Buffer;
using engine::Result;
using Matrix = Eigen::Affine3d;
using Vector = Eigen::Vector3d;

// In distances of the eye from what it looks at.
constexpr double kFading = 9, kNearest = 0.01, kFarthest = 1000, kShadowLift = 1.5e-3;
constexpr double kGrazing = 0.05; // light that comes in flatter throws no shadow worth showing

Vector vectorOf(const Double3& v) { return {v[0], v[1], v[2]}; }

gpu::ObjectMatrix packedMatrix(const Matrix& matrix) {
    gpu::ObjectMatrix result;
    const Eigen::Matrix4f numbers = matrix.matrix().cast<float>();
    std::memcpy(&result, numbers.data(), sizeof result); // both by columns
    return result;
}

Matrix matrixOf(const Pose& pose, const Double3& origin) {
    const Eigen::Quaterniond turn(pose.turn[3], pose.turn[0], pose.turn[1], pose.turn[2]);
    return Eigen::Translation3d(vectorOf(pose.place - origin)) * turn * Eigen::Scaling(pose.scale);
}

// Along the light, onto a plane and a little off it.
Matrix shadowOnto(const Vector& point, const Vector& normal, const Vector& light, double lift) {
    const double steep = normal.dot(light);
    Matrix flat;
    flat.linear() = Eigen::Matrix3d::Identity() - light * normal.transpose() / steep;
    flat.translation() = light * (normal.dot(point) / steep) + normal * lift;
    flat.makeAffine();
    return flat;
}

engine::Camera cameraOf(const brittle::CameraDescription& d, const Double3& origin) {
    const auto distance = static_cast<float>(brittle::length(d.eye - d.target));
    engine::Camera camera;
    camera.eye = brittle::toFloat(d.eye - origin);
    camera.target = brittle::toFloat(d.target - origin);
    camera.up = brittle::toFloat(d.up);
    camera.fov_y = static_cast<float>(d.field_of_view * std::numbers::pi / 180);
    camera.near_plane = static_cast<float>(kNearest) * distance;
    camera.far_plane = static_cast<float>(kFarthest) * distance;
    return camera;
}

// Objects are the bodies, and for each plane their shadows on it. Buffers hold the bodies that were there when the last one
// appeared, those of them that have gone since as nothing.
class DrawnWorld : public WorldPicture {
public:
    explicit DrawnWorld(const Spectacle& s)
        : s_(s), camera_(cameraOf(s.scene.camera, s.origin)),
          distance_(brittle::length(s.scene.camera.eye - s.scene.camera.target)) {}

    Result<void> createRenderer() {
        auto renderer = engine::Renderer::create(s_.device, s_.scene.camera.width, s_.scene.camera.height);
        if (!renderer) return renderer.error();
        renderer_ = std::move(*renderer);
        return {};
    }

    Result<engine::Picture> draw(const Moment& moment) override {
        const Poses& poses = moment.poses;
        const bool had_dust = !clouds_.empty(), is_new = hasNewBody(poses);
        if (is_new) gather(poses);
        if (is_new || had_dust || !moment.specks.empty()) {
            gatherDust(moment.specks);
            if (auto made = createBuffers(); !made) return made.error();
        }
        place(poses);
        return renderer_->draw({vertices_, indices_, commands_, matrices_, draw_count_, colors_}, camera_);
    }

private:
    size_t objectCount() const { return bodies_.size() * (1 + planes_.size()) + clouds_.size(); }
    size_t cloudAt(size_t cloud) const { return bodies_.size() * (1 + planes_.size()) + cloud; }
    size_t shadowOf(size_t object, size_t plane) const { return bodies_.size() * (1 + plane) + object; }
    const brittle::BodyLook& lookOf(size_t object) const { return s_.surfaces.bodies[bodies_[object]]; }

    // Bodies are numbered as they appear, and are asked for in that order.
    bool hasNewBody(const Poses& poses) const {
        return std::any_of(poses.begin() + static_cast<ptrdiff_t>(known_), poses.end(),
                           [](const auto& pose) { return pose.has_value(); });
    }
    void gather(const Poses& poses) {
        known_ = poses.size();
        bodies_.clear();
        planes_.clear();
        solids_.clear();
        for (size_t body = 0; body < poses.size(); ++body) {
            if (!poses[body]) continue;
            (s_.surfaces.bodies[body].is_plane ? planes_ : solids_).push_back(bodies_.size());
            bodies_.push_back(body);
        }
    }

    // By the bodies that they come of, whose color they have.
    void gatherDust(const std::vector<Speck>& specks) {
        clouds_.clear();
        for (const Speck& speck : specks)
            clouds_[speck.origin].push_back(speck);
    }
    // A square that faces the eye, of a pixel at the least.
    void addSquare(const Speck& speck, std::vector<brittle::FragmentVertex>& vertices, std::vector<uint32_t>& indices) const {
        const Vector eye = vectorOf(brittle::toDouble(camera_.eye)), middle = vectorOf(speck.place - s_.origin);
        const Vector back = (eye - vectorOf(brittle::toDouble(camera_.target))).normalized();
        const Vector right = vectorOf(brittle::toDouble(camera_.up)).cross(back).normalized(), up = back.cross(right);
        const double pixel = 2 * std::tan(double{camera_.fov_y} / 2) * back.dot(eye - middle) / s_.scene.camera.height;
        const double half = std::max(speck.radius, pixel / 2);
        const auto first = static_cast<uint32_t>(vertices.size());
        for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
            const Eigen::Vector3f place = (middle + half * (x * right + y * up)).cast<float>(), normal = back.cast<float>();
            vertices.push_back({{place.x(), place.y(), place.z()}, {normal.x(), normal.y(), normal.z()}, {0, 0}});
        }
        for (const uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u})
            indices.push_back(first + corner);
    }
    // As one mesh, with a command for each cloud behind those of the solids.
    std::vector<gpu::DrawCommand> addDust(std::vector<brittle::FragmentVertex>& vertices,
                                          std::vector<uint32_t>& indices) const {
        std::vector<gpu::DrawCommand> commands;
        for (const auto& [origin, specks] : clouds_) {
            const auto first = static_cast<uint32_t>(indices.size());
            for (const Speck& speck : specks)
                addSquare(speck, vertices, indices);
            const auto instance = static_cast<uint32_t>(2 * cloudAt(commands.size()));
            commands.push_back({static_cast<uint32_t>(indices.size()) - first, 1, first, 0, instance});
        }
        return commands;
    }

    Result<void> createBuffers() {
        std::vector<brittle::FragmentVertex> vertices;
        std::vector<uint32_t> indices;
        first_of_.clear();
        for (const size_t body : bodies_) {
            const uint32_t index = s_.surfaces.bodies[body].mesh;
            if (!first_of_
                     .try_emplace(index, First{static_cast<int32_t>(vertices.size()), static_cast<uint32_t>(indices.size())})
                     .second)
                continue;
            const brittle::SurfaceMesh& mesh = s_.surfaces.meshes[index];
            vertices.insert(vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
            indices.insert(indices.end(), mesh.indices.begin(), mesh.indices.end());
        }
        const std::vector<gpu::DrawCommand> commands = drawCommands(addDust(vertices, indices));
        draw_count_ = static_cast<uint32_t>(commands.size());
        auto made = keep(drawnBuffer(s_.device, vertices, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT), vertices_);
        if (made) made = keep(drawnBuffer(s_.device, indices, VK_BUFFER_USAGE_INDEX_BUFFER_BIT), indices_);
        if (made) made = keep(drawnBuffer(s_.device, commands, 0), commands_);
        if (made) made = keep(drawnBuffer(s_.device, colors(), 0), colors_);
        if (made) made = keep(drawnBuffer(s_.device, std::vector<gpu::ObjectMatrix>(objectCount()), 0), matrices_);
        return made;
    }
    static Result<void> keep(Result<Buffer> made, Buffer& place) {
        if (!made) return made.error();
        place = std::move(*made);
        return {};
    }

    // Solids and dust, then what fades out: planes, and the shadows that lie a little above them.
    std::vector<gpu::DrawCommand> drawCommands(const std::vector<gpu::DrawCommand>& dust) const {
        std::vector<gpu::DrawCommand> commands;
        for (const size_t solid : solids_)
            addDraws(commands, solid, solid);
        commands.insert(commands.end(), dust.begin(), dust.end());
        for (const size_t plane : planes_)
            addDraws(commands, plane, plane);
        for (size_t plane = 0; plane < planes_.size(); ++plane)
            for (const size_t solid : solids_)
                addDraws(commands, solid, shadowOf(solid, plane));
        return commands;
    }
    // What it looks like, and as what it is drawn.
    void addDraws(std::vector<gpu::DrawCommand>& commands, size_t look, size_t object) const {
        const brittle::SurfaceMesh& mesh = s_.surfaces.meshes[lookOf(look).mesh];
        const First first = first_of_.at(lookOf(look).mesh);
        const auto all = static_cast<uint32_t>(mesh.indices.size());
        const uint32_t outer = mesh.outer_index_count;
        const auto instance = static_cast<uint32_t>(2 * object);
        if (outer > 0) commands.push_back({outer, 1, first.index, first.vertex, instance});
        if (outer < all) commands.push_back({all - outer, 1, first.index + outer, first.vertex, instance + 1});
    }

    std::vector<gpu::ObjectColor> colors() const {
        const double fading = kFading * distance_;
        std::vector<gpu::ObjectColor> colors(objectCount(), shadowColor(fading));
        for (size_t object = 0; object < bodies_.size(); ++object)
            colors[object] = colorOf(lookOf(object), bodies_[object], fading);
        size_t cloud = 0;
        for (const auto& [origin, specks] : clouds_)
            colors[cloudAt(cloud++)] = dustColor(s_.surfaces.bodies[origin], origin);
        return colors;
    }

    void place(const Poses& poses) {
        auto* matrices = matrices_.mappedAs<gpu::ObjectMatrix>();
        for (size_t cloud = 0; cloud < clouds_.size(); ++cloud)
            matrices[cloudAt(cloud)] = packedMatrix(Matrix::Identity());
        for (const size_t solid : solids_) {
            const auto matrix = matrixFor(solid, poses);
            matrices[solid] = matrix ? packedMatrix(*matrix) : gpu::ObjectMatrix{};
        }
        for (size_t plane = 0; plane < planes_.size(); ++plane) {
            const Matrix own = *matrixFor(planes_[plane], poses); // planes do not break
            matrices[planes_[plane]] = packedMatrix(own * Eigen::Scaling(stretchOf(planes_[plane], own)));
            placeShadows(plane, own, poses);
        }
    }
    std::optional<Matrix> matrixFor(size_t object, const Poses& poses) const {
        const auto& pose = poses[bodies_[object]];
        return pose ? std::optional(matrixOf(*pose, s_.origin)) : std::nullopt;
    }

    // So that it ends nowhere within sight.
    double stretchOf(size_t object, const Matrix& plane) const {
        const Vector eye = vectorOf(brittle::toDouble(camera_.eye));
        const double edge = 2 * std::abs(s_.surfaces.meshes[lookOf(object).mesh].vertices[0].position[0]);
        return 2 * (kFading * distance_ + (plane.translation() - eye).norm()) / edge;
    }

    void placeShadows(size_t plane, const Matrix& own, const Poses& poses) {
        const Vector light = vectorOf(brittle::toDouble(engine::keyLight(camera_)));
        const Vector normal = own.linear().col(1), point = own.translation();
        const bool is_lit = normal.dot(light) > kGrazing;
        const Matrix flat = is_lit ? shadowOnto(point, normal, light, kShadowLift * distance_) : Matrix::Identity();
        auto* matrices = matrices_.mappedAs<gpu::ObjectMatrix>();
        for (const size_t solid : solids_) {
            const auto matrix = matrixFor(solid, poses);
            const bool is_seen = is_lit && matrix && normal.dot(matrix->translation() - point) > 0;
            matrices[shadowOf(solid, plane)] = is_seen ? packedMatrix(flat * *matrix) : gpu::ObjectMatrix{};
        }
    }

    struct First {
        int32_t vertex;
        uint32_t index;
    };
    const Spectacle s_;
    engine::Camera camera_;
    double distance_;
    size_t known_ = 0;                              // bodies that have been asked about
    std::vector<size_t> bodies_;                    // by object
    std::vector<size_t> planes_, solids_;           // objects
    std::map<uint32_t, std::vector<Speck>> clouds_; // of dust, by the body that it comes of
    std::unordered_map<uint32_t, First> first_of_;  // by mesh
    uint32_t draw_count_ = 0;
    Buffer vertices_, indices_, commands_, colors_, matrices_;
    std::unique_ptr<engine::Renderer> renderer_;
};

} // namespace

Result<std::unique_ptr<WorldPicture>> WorldPicture::create(const Spectacle& spectacle) {
    auto world = std::make_unique<DrawnWorld>(spectacle);
    if (auto made = world->createRenderer(); !made) return made.error();
    return std::unique_ptr<WorldPicture>(std::move(world));
}

} // namespace cli
