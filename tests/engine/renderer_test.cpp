#include "engine/renderer.h"
#include "tests/engine/test_device.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace engine;
using namespace engine_test;

namespace {

constexpr uint32_t kWidth = 320, kHeight = 180;

// The six faces of a cube of side 2, each as four vertices; face k looks along axis k / 2, outwards.
void addCube(std::vector<gpu::SceneVertex>& vertices, std::vector<uint32_t>& indices) {
    for (unsigned face = 0; face < 6; ++face) {
        const unsigned axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
        const float side = face % 2 == 0 ? -1.0f : 1.0f;
        for (unsigned corner = 0; corner < 4; ++corner) {
            gpu::SceneVertex vertex{};
            vertex.position[axis] = vertex.normal[axis] = side;
            vertex.position[u] = (corner & 1u) != 0 ? 1.0f : -1.0f;
            vertex.position[v] = (corner & 2u) != 0 ? 1.0f : -1.0f;
            vertices.push_back(vertex);
        }
        const auto first = static_cast<uint32_t>(4 * face);
        const uint32_t outwards[] = {0, 1, 3, 0, 3, 2}, inwards[] = {0, 3, 1, 0, 2, 3};
        for (const uint32_t corner : side > 0 ? outwards : inwards)
            indices.push_back(first + corner);
    }
}

gpu::ObjectMatrix placedAt(float x, float y, float z) { return {{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1}}}; }

template <class T>
std::vector<uint32_t> asWords(const std::vector<T>& values) {
    std::vector<uint32_t> words(values.size() * sizeof(T) / 4);
    std::memcpy(words.data(), values.data(), words.size() * 4);
    return words;
}

// Two cubes beside each other, through the compute queue: the left one outer on all sides, the right one with an inner face
// towards the eye.
class TwoCubes {
public:
    TwoCubes() {
        std::vector<gpu::SceneVertex> vertices;
        std::vector<uint32_t> indices;
        addCube(vertices, indices);
        const std::vector<gpu::DrawCommand> draws = {
            {36, 1, 0, 0, 0},
            {0, 0, 0, 0, 1}, // all six faces, and none
            {30, 1, 0, 0, 2},
            {6, 1, 30, 0, 3}, // five faces, and the one towards +z
        };
        EXPECT_TRUE(commands_.begin());
        vertices_ = onDevice(asWords(vertices), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
        indices_ = onDevice(indices, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
        draws_ = onDevice(asWords(draws), 0);
        matrices_ = onDevice(asWords<gpu::ObjectMatrix>({placedAt(-1.5f, 0, 0), placedAt(1.5f, 0, 0)}), 0);
        commands_.releaseToGraphics(released());
        finish(commands_);
    }
    DrawScene scene() const { return {vertices_, indices_, draws_, matrices_, 4}; }
    std::vector<BufferView> released() const { return {vertices_, indices_, draws_, matrices_}; }
    Buffer onDevice(const std::vector<uint32_t>& words, VkBufferUsageFlags usage) {
        uploads_.push_back(upload(device(), words));
        auto buffer = Buffer::create(device(), words.size() * 4, BufferDomain::Device, usage, "scene");
        EXPECT_TRUE(buffer);
        commands_.copy(uploads_.back(), *buffer);
        return std::move(*buffer);
    }

private:
    Commands commands_{device()};
    std::vector<Buffer> uploads_;
    Buffer vertices_, indices_, draws_, matrices_;
};

std::unique_ptr<Renderer> makeRenderer() {
    auto made = Renderer::create(device(), kWidth, kHeight);
    EXPECT_TRUE(made) << (made ? "" : made.error().message);
    return made ? std::move(*made) : nullptr;
}

Camera frontCamera() { return frameBounds({-2.5f, -1, -1}, {2.5f, 1, 1}, float(kWidth) / kHeight, {0, 0, 1}); }

// Vulkan without drawIndirectFirstInstance or without a graphics queue cannot draw.
bool canDraw() { return device().hasGraphics() && device().features().draw_indirect_first_instance; }

bool isGray(const std::array<uint8_t, 4>& p) { return std::abs(p[0] - p[2]) < 16; }
bool isClay(const std::array<uint8_t, 4>& p) { return p[0] > p[2] + 60; }

#define SKIP_WITHOUT_GRAPHICS                                                                                                  \
    if (!canDraw()) GTEST_SKIP() << "this device cannot draw"

} // namespace

TEST(Renderer, ShowsOuterAndInnerFacesOverTheBackground) {
    SKIP_WITHOUT_GRAPHICS;
    TwoCubes cubes;
    const auto renderer = makeRenderer();
    ASSERT_NE(renderer, nullptr);
    const auto picture = renderer->draw(cubes.scene(), frontCamera(), {}, cubes.released());
    ASSERT_TRUE(picture) << picture.error().message;
    ASSERT_EQ(picture->pixels.size(), size_t(4) * kWidth * kHeight);

    const auto left = picture->at(kWidth / 4, kHeight / 2), right = picture->at(3 * kWidth / 4, kHeight / 2);
    const auto middle = picture->at(kWidth / 2, kHeight / 2), corner = picture->at(2, 2);
    EXPECT_TRUE(isClay(right)) << int(right[0]) << " " << int(right[1]) << " " << int(right[2]);
    EXPECT_FALSE(isClay(left));
    EXPECT_GT(left[0], left[2]); // stone is a little warm
    EXPECT_TRUE(isGray(middle) && isGray(corner));
    EXPECT_EQ(corner[3], 255);
    EXPECT_GT(picture->at(kWidth / 2, 2)[1], picture->at(kWidth / 2, kHeight - 3)[1]); // lighter at the top
}

TEST(Renderer, EmptySceneIsBackground) {
    SKIP_WITHOUT_GRAPHICS;
    const auto picture = makeRenderer()->draw({}, frontCamera());
    ASSERT_TRUE(picture) << picture.error().message;
    for (uint32_t y = 0; y < kHeight; y += 7) {
        for (uint32_t x = 0; x < kWidth; x += 7)
            ASSERT_TRUE(isGray(picture->at(x, y)));
    }
}

// The near cube hides the far one, whichever is drawn first; edges are smooth.
TEST(Renderer, NearerHidesFarther) {
    SKIP_WITHOUT_GRAPHICS;
    TwoCubes cubes;
    const auto renderer = makeRenderer();
    const Camera camera = frameBounds({-1, -1, -4}, {1, 1, 4}, float(kWidth) / kHeight, {0, 0, 1});
    for (const float left_depth : {-3.0f, 3.0f}) {
        DrawScene scene = cubes.scene();
        const Buffer matrices =
            upload(device(), asWords<gpu::ObjectMatrix>({placedAt(0, 0, left_depth), placedAt(0, 0, -left_depth)}));
        scene.matrices = matrices;
        const auto picture = renderer->draw(scene, camera, {}, left_depth < 0 ? cubes.released() : std::vector<BufferView>{});
        ASSERT_TRUE(picture);
        EXPECT_EQ(isClay(picture->at(kWidth / 2, kHeight / 2)), left_depth < 0);
    }
}

// The left cube is green and keeps its color whatever the light; the right one is blue and has faded out at that distance.
TEST(Renderer, ObjectsHaveColorsOfTheirOwn) {
    SKIP_WITHOUT_GRAPHICS;
    TwoCubes cubes;
    DrawScene scene = cubes.scene();
    const Buffer colors =
        upload(device(), asWords<gpu::ObjectColor>({{{0, 1, 0, 0}, {0, 1, 0, 0}}, {{0, 0, 1, 1}, {0, 0, 1, 0.5f}}}));
    scene.colors = colors;
    const auto renderer = makeRenderer();
    const auto picture = renderer->draw(scene, frontCamera(), {}, cubes.released());
    const auto background = renderer->draw({}, frontCamera());
    ASSERT_TRUE(picture && background);
    EXPECT_EQ(picture->at(kWidth / 4, kHeight / 2), (std::array<uint8_t, 4>{0, 255, 0, 255}));
    EXPECT_EQ(picture->at(3 * kWidth / 4, kHeight / 2), background->at(3 * kWidth / 4, kHeight / 2));
}

TEST(Renderer, SupersamplingSmoothsEdges) {
    SKIP_WITHOUT_GRAPHICS;
    TwoCubes cubes;
    const auto turned = frameBounds({-2.5f, -1, -1}, {2.5f, 1, 1}, float(kWidth) / kHeight, {0.4f, 0.3f, 1});
    const auto picture = makeRenderer()->draw(cubes.scene(), turned, {}, cubes.released());
    ASSERT_TRUE(picture);
    // Along a row through the clay face some pixel lies between clay and what surrounds it.
    int between = 0;
    for (uint32_t y = kHeight / 3; y < 2 * kHeight / 3; ++y) {
        for (uint32_t x = 0; x < kWidth; ++x) {
            const auto p = picture->at(x, y);
            between += p[0] - p[2] > 25 && p[0] - p[2] < 55 ? 1 : 0;
        }
    }
    EXPECT_GT(between, 10);
}

TEST(Renderer, SaysWhatItCannotDraw) {
    SKIP_WITHOUT_GRAPHICS;
    EXPECT_FALSE(Renderer::create(device(), 0, 100));
    EXPECT_FALSE(Renderer::create(device(), 1u << 20, 100));
    const auto minimal = Renderer::create(minimalDevice(), kWidth, kHeight);
    ASSERT_FALSE(minimal);
    EXPECT_EQ(minimal.error().code, ErrorCode::Device);
    TwoCubes cubes;
    const auto renderer = makeRenderer();
    DrawScene scene = cubes.scene();
    scene.draw_count = 5;
    EXPECT_FALSE(renderer->draw(scene, frontCamera()));
    scene = cubes.scene();
    scene.vertices = scene.draw_commands;
    EXPECT_FALSE(renderer->draw(scene, frontCamera()));
    scene = cubes.scene();
    scene.matrices = {};
    EXPECT_FALSE(renderer->draw(scene, frontCamera()));
}

TEST(Camera, FramesTheWholeBoxTightly) {
    const Vec3 lower = {-3, 1, -2}, upper = {5, 2, 7};
    for (const Vec3& direction : {Vec3{0, 0, 1}, Vec3{0.5f, 0.4f, 1}, Vec3{-1, 0.1f, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}}) {
        for (const float aspect : {0.5f, 1.0f, 2.0f}) {
            const gpu::mat4 m = frameBounds(lower, upper, aspect, direction).viewProjection(aspect);
            float widest = 0;
            for (unsigned corner = 0; corner < 8; ++corner) {
                std::array<float, 4> clip{};
                for (unsigned row = 0; row < 4; ++row) {
                    clip[row] = m.m[12 + row];
                    for (unsigned k = 0; k < 3; ++k)
                        clip[row] += m.m[4 * k + row] * ((corner >> k & 1u) != 0 ? upper[k] : lower[k]);
                }
                widest = std::max({widest, std::abs(clip[0] / clip[3]), std::abs(clip[1] / clip[3])});
                EXPECT_TRUE(clip[2] > 0 && clip[2] < clip[3]);
            }
            EXPECT_LT(widest, 1.0f);
            EXPECT_GT(widest, 0.85f);
        }
    }
}

TEST(ImageIo, WritesPng) {
    Picture picture{3, 2, std::vector<uint8_t>(24, 200)};
    const auto path = std::filesystem::temp_directory_path() / ("engine_test_" + std::to_string(getpid()) + ".png");
    ASSERT_TRUE(writePng(picture, path.string()));
    std::ifstream file(path, std::ios::binary);
    char head[8] = {};
    file.read(head, 8);
    EXPECT_EQ(std::memcmp(head, "\x89PNG\r\n\x1a\n", 8), 0);
    std::filesystem::remove(path);
    const auto nowhere = writePng(picture, "/no/such/folder/picture.png");
    ASSERT_FALSE(nowhere);
    EXPECT_NE(nowhere.error().message.find("/no/such/folder"), std::string::npos);
}
