// By GLFW. Pictures are drawn off screen, as brittle simulate draws them, and shown by the oldest function there is for that,
// so that neither a swapchain nor OpenGL's libraries are needed to build this.
#include "modules/brittle/dynamics/world.h"
#include "tools/brittle/body_cast.h"
#include "tools/brittle/world_picture.h"
#include "tools/shader_reload/scene_window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace shader_reload {
namespace {

using engine::Error;
using engine::ErrorCode;
using engine::Result;

constexpr unsigned kRgba = 0x1908, kBytes = 0x1401; // GL_RGBA, GL_UNSIGNED_BYTE
using DrawPixels = void (*)(int width, int height, unsigned format, unsigned type, const void* pixels);
using RasterPos = void (*)(float x, float y);
using PixelZoom = void (*)(float x, float y);

std::string reason() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text != nullptr ? text : "no reason given";
}

class GlfwWindow : public SceneWindow {
public:
    GlfwWindow(engine::Device& device, cli::StagedScene& staged, brittle::World& world)
        : cast_(world, staged.surfaces), spectacle_{device, staged.scene, staged.surfaces,
                                                    brittle::originOf(staged.contents.bodies)} {}
    ~GlfwWindow() override {
        if (window_ != nullptr) glfwDestroyWindow(window_);
        glfwTerminate();
    }

    Result<void> create() {
        auto picture = cli::WorldPicture::create(spectacle_);
        if (!picture) return picture.error();
        picture_ = std::move(*picture);
        if (glfwInit() == 0) return Error{ErrorCode::BadInput, "there is no screen for a window: " + reason()};
        glfwWindowHint(GLFW_RESIZABLE, GLFW_FALSE);
        return show();
    }

    Result<void> show() override {
        auto poses = cast_.poses();
        if (!poses) return poses.error();
        const auto drawn = picture_->draw({std::move(*poses), {}});
        if (!drawn) return drawn.error();
        if (window_ == nullptr)
            if (auto opened = openFor(*drawn); !opened) return opened;
        raster_pos_(-1, 1);
        pixel_zoom_(1, -1); // rows from the top
        draw_pixels_(static_cast<int>(drawn->width), static_cast<int>(drawn->height), kRgba, kBytes, drawn->pixels.data());
        glfwSwapBuffers(window_);
        glfwPollEvents();
        return {};
    }

    bool isClosed() const override { return glfwWindowShouldClose(window_) != 0; }

private:
    Result<void> openFor(const engine::Picture& picture) {
        const std::string title = "shader_reload: " + spectacle_.scene.name;
        window_ = glfwCreateWindow(static_cast<int>(picture.width), static_cast<int>(picture.height), title.c_str(), nullptr,
                                   nullptr);
        if (window_ == nullptr) return Error{ErrorCode::BadInput, "there is no window: " + reason()};
        glfwMakeContextCurrent(window_);
        draw_pixels_ = reinterpret_cast<DrawPixels>(glfwGetProcAddress("glDrawPixels"));
        raster_pos_ = reinterpret_cast<RasterPos>(glfwGetProcAddress("glRasterPos2f"));
        pixel_zoom_ = reinterpret_cast<PixelZoom>(glfwGetProcAddress("glPixelZoom"));
        if (draw_pixels_ != nullptr && raster_pos_ != nullptr && pixel_zoom_ != nullptr) return {};
        return Error{ErrorCode::BadInput, "the screen has no OpenGL that can show a picture"};
    }

    cli::BodyCast cast_;
    cli::Spectacle spectacle_;
    std::unique_ptr<cli::WorldPicture> picture_;
    GLFWwindow* window_ = nullptr;
    DrawPixels draw_pixels_ = nullptr;
    RasterPos raster_pos_ = nullptr;
    PixelZoom pixel_zoom_ = nullptr;
};

} // namespace

Result<std::unique_ptr<SceneWindow>> SceneWindow::open(engine::Device& device, cli::StagedScene& staged,
                                                       brittle::World& world) {
    auto window = std::make_unique<GlfwWindow>(device, staged, world);
    if (auto made = window->create(); !made) return made.error();
    return std::unique_ptr<SceneWindow>(std::move(window));
}

} // namespace shader_reload
