// Where there was no GLFW when this was built.
#include "tools/shader_reload/scene_window.h"

namespace shader_reload {

engine::Result<std::unique_ptr<SceneWindow>> SceneWindow::open(engine::Device&, cli::StagedScene&, brittle::World&) {
    return engine::Error{engine::ErrorCode::BadInput,
                         "this program was built without windows; install libglfw3-dev and build it anew"};
}

} // namespace shader_reload
