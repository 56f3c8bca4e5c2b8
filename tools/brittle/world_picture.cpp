#include "tools/brittle/world_picture.h"

#include "engine/renderer.h"
#include "modules/brittle/mesh/vector_math.h"
#include "tools/brittle/drawn_buffer.h"
#include "tools/brittle/shown_colors.h"

#include <Eigen/Geometry>

#include <numbers>

namespace cli {
namespace {

using brittle::Double3;
using brittle::Pose;
using brittle::operator-; // of arrays, which argument-dependent lookup does not find
using engine::Buffer;
using engine::Result;
using Matrix = Eigen::Affine3d;
using Vector = Eigen::Vector3d;

// In distances of the eye from what it looks at.
constexpr double kFading = 9, kNearest = 0.01, kFarthest = 1000, kShadowLift = 1.5e-3;
constexpr double kGrazing = 0.05; // light that comes in flatter throws no shadow worth showing

Vector vectorOf(const Double3& v) { return {v[0], v[1], v[2]}; }

gpu::ObjectMatrix packed(const Matrix& matrix) {
    gpu::ObjectMatrix result;
    const Eigen::Matrix4f numbers = matrix.matrix().cast<float>();
    std::memcpy(&result, numbers.data(), sizeof result); // both by columns
    return result;
}

Matrix matrixOf(const Pose& pose, const Double3& origin) {
    const Eigen::Quaterniond turn(pose.turn[3], pose.turn[0], pose.turn[1], pose.turn[2]);
    return Eigen::Translation3d(vectorOf(pose.place - origin)) * turn;
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

// Objects are the bodies, and for each plane their shadows on it.
class DrawnWorld : public WorldPicture {
public:
    explicit DrawnWorld(const Spectacle& s)
        : s_(s), camera_(cameraOf(s.scene.camera, s.origin)),
          distance_(brittle::length(s.scene.camera.eye - s.scene.camera.target)) {
        for (size_t body = 0; body < s.surfaces.bodies.size(); ++body)
            (s.surfaces.bodies[body].is_plane ? planes_ : solids_).push_back(body);
    }

    Result<void> createAll() {
        auto renderer = engine::Renderer::create(s_.device, s_.scene.camera.width, s_.scene.camera.height);
        if (!renderer) return renderer.error();
        renderer_ = std::move(*renderer);
        return createBuffers();
    }

    Result<engine::Picture> draw(std::span<const Pose> poses) override {
        place(poses);
        return renderer_->draw({vertices_, indices_, commands_, matrices_, draw_count_, colors_}, camera_);
    }

private:
    size_t objectCount() const { return s_.surfaces.bodies.size() * (1 + planes_.size()); }
    size_t shadowOf(size_t body, size_t plane) const { return s_.surfaces.bodies.size() * (1 + plane) + body; }

    Result<void> createBuffers() {
        std::vector<brittle::FragmentVertex> vertices;
        std::vector<uint32_t> indices;
        for (const brittle::SurfaceMesh& mesh : s_.surfaces.meshes) {
            first_vertex_.push_back(static_cast<int32_t>(vertices.size()));
            first_index_.push_back(static_cast<uint32_t>(indices.size()));
            vertices.insert(vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
            indices.insert(indices.end(), mesh.indices.begin(), mesh.indices.end());
        }
        const std::vector<gpu::DrawCommand> commands = drawCommands();
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

    // Solids, then what fades out: planes, and the shadows that lie a little above them.
    std::vector<gpu::DrawCommand> drawCommands() const {
        std::vector<gpu::DrawCommand> commands;
        for (const size_t body : solids_)
            addDraws(commands, body, body);
        for (const size_t body : planes_)
            addDraws(commands, body, body);
        for (size_t plane = 0; plane < planes_.size(); ++plane)
            for (const size_t body : solids_)
                addDraws(commands, body, shadowOf(body, plane));
        return commands;
    }
    void addDraws(std::vector<gpu::DrawCommand>& commands, size_t body, size_t object) const {
        const uint32_t mesh = s_.surfaces.bodies[body].mesh;
        const auto all = static_cast<uint32_t>(s_.surfaces.meshes[mesh].indices.size());
        const uint32_t outer = s_.surfaces.meshes[mesh].outer_index_count, first = first_index_[mesh];
        const auto instance = static_cast<uint32_t>(2 * object);
        if (outer > 0) commands.push_back({outer, 1, first, first_vertex_[mesh], instance});
        if (outer < all) commands.push_back({all - outer, 1, first + outer, first_vertex_[mesh], instance + 1});
    }

    std::vector<gpu::ObjectColor> colors() const {
        const double fading = kFading * distance_;
        std::vector<gpu::ObjectColor> colors(objectCount(), shadowColor(fading));
        for (size_t body = 0; body < s_.surfaces.bodies.size(); ++body)
            colors[body] = colorOf(s_.surfaces.bodies[body], body, fading);
        return colors;
    }

    void place(std::span<const Pose> poses) {
        auto* matrices = matrices_.mappedAs<gpu::ObjectMatrix>();
        for (const size_t body : solids_)
            matrices[body] = packed(matrixOf(poses[body], s_.origin));
        for (size_t plane = 0; plane < planes_.size(); ++plane) {
            const Matrix own = matrixOf(poses[planes_[plane]], s_.origin);
            matrices[planes_[plane]] = packed(own * Eigen::Scaling(stretchOf(planes_[plane], own)));
            placeShadows(plane, own, poses);
        }
    }

    // So that it ends nowhere within sight.
    double stretchOf(size_t body, const Matrix& plane) const {
        const Vector eye = vectorOf(brittle::toDouble(camera_.eye));
        const double edge = 2 * std::abs(s_.surfaces.meshes[s_.surfaces.bodies[body].mesh].vertices[0].position[0]);
        return 2 * (kFading * distance_ + (plane.translation() - eye).norm()) / edge;
    }

    void placeShadows(size_t plane, const Matrix& own, std::span<const Pose> poses) {
        const Vector light = vectorOf(brittle::toDouble(engine::keyLight(camera_)));
        const Vector normal = own.linear().col(1), point = own.translation();
        const bool is_lit = normal.dot(light) > kGrazing;
        const Matrix flat = is_lit ? shadowOnto(point, normal, light, kShadowLift * distance_) : Matrix::Identity();
        auto* matrices = matrices_.mappedAs<gpu::ObjectMatrix>();
        for (const size_t body : solids_) {
            const Matrix matrix = matrixOf(poses[body], s_.origin);
            const bool is_above = normal.dot(matrix.translation() - point) > 0;
            matrices[shadowOf(body, plane)] = is_lit && is_above ? packed(flat * matrix) : gpu::ObjectMatrix{};
        }
    }

    const Spectacle s_;
    engine::Camera camera_;
    double distance_;
    std::vector<size_t> planes_, solids_; // bodies
    std::vector<int32_t> first_vertex_;   // by mesh
    std::vector<uint32_t> first_index_;
    uint32_t draw_count_ = 0;
    Buffer vertices_, indices_, commands_, colors_, matrices_;
    std::unique_ptr<engine::Renderer> renderer_;
};

} // namespace

Result<std::unique_ptr<WorldPicture>> WorldPicture::create(const Spectacle& spectacle) {
    auto world = std::make_unique<DrawnWorld>(spectacle);
    if (auto made = world->createAll(); !made) return made.error();
    return std::unique_ptr<WorldPicture>(std::move(world));
}

} // namespace cli
