#include "tools/brittle/scene_source.h"

#include "modules/brittle/scene/library/builtin_scenes.h"
#include "modules/brittle/scene/nearest_name.h"
#include "modules/brittle/scene/scene_file.h"
#include "tools/brittle/example_files.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".toml";

// The file that holds the scene; empty for a built-in one. A file of the caller's goes before an example of the same name.
fs::path fileOf(const std::string& name) {
    if (!name.ends_with(kEnding)) return exampleFile(name + std::string(kEnding));
    std::error_code unreadable;
    const fs::path example = fs::exists(name, unreadable) ? fs::path() : exampleFile(name);
    return example.empty() ? fs::path(name) : example;
}

// A name that is nearly an example's.
std::string exampleLike(const std::string& name) {
    std::vector<std::string> names;
    for (const fs::path& file : exampleFiles(std::string(kEnding)))
        names.push_back(file.stem().string());
    const std::vector<std::string_view> known(names.begin(), names.end());
    return std::string(brittle::nearestName(name, known));
}

} // namespace

engine::Result<brittle::SceneDescription> readSceneOrBuiltin(const std::string& name) {
    if (const fs::path file = fileOf(name); !file.empty()) return brittle::readScene(file);
    if (name.find('/') != std::string::npos)
        return engine::Error{engine::ErrorCode::BadInput, name + ": is no scene file; its name has to end in .toml"};
    auto scene = brittle::makeBuiltinScene(name);
    const std::string like = scene ? "" : exampleLike(name);
    if (like.empty()) return scene;
    return engine::Error{engine::ErrorCode::BadInput, "no scene is named '" + name + "', did you mean '" + like + "'?"};
}

fs::path folderOf(const std::string& name) { return fileOf(name).parent_path(); }

} // namespace cli
