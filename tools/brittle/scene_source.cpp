#include "tools/brittle/scene_source.h"

#include "modules/brittle/scene/library/builtin_scenes.h"
#include "modules/brittle/scene/scene_file.h"

namespace cli {
namespace {

bool isFile(const std::string& name) { return name.ends_with(".toml"); }

} // namespace

engine::Result<brittle::SceneDescription> readSceneOrBuiltin(const std::string& name) {
    if (isFile(name)) return brittle::readScene(std::filesystem::path(name));
    if (name.find('/') != std::string::npos)
        return engine::Error{engine::ErrorCode::BadInput, name + ": is no scene file; its name has to end in .toml"};
    return brittle::makeBuiltinScene(name);
}

std::filesystem::path folderOf(const std::string& name) {
    return isFile(name) ? std::filesystem::path(name).parent_path() : std::filesystem::path();
}

} // namespace cli
