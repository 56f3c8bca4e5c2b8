#include "tools/brittle/scene_files.h"

#include "tools/brittle/same_file.h"
#include "tools/brittle/scene_source.h"

#include <nlohmann/json.hpp>

#include <fstream>

namespace cli {

namespace fs = std::filesystem;

std::vector<fs::path> filesOfModel(const fs::path& model) {
    std::vector<fs::path> files = {model};
    std::error_code unknown;
    if (model.extension() != ".gltf" || !fs::is_regular_file(model, unknown)) return files;
    std::ifstream file(model);
    const auto json = nlohmann::json::parse(file, nullptr, /*allow_exceptions=*/false);
    if (!json.is_object() || !json.contains("buffers") || !json["buffers"].is_array()) return files;
    for (const auto& buffer : json["buffers"]) {
        if (!buffer.is_object() || !buffer.contains("uri") || !buffer["uri"].is_string()) continue;
        const std::string name = buffer["uri"];
        if (!name.starts_with("data:")) files.push_back(model.parent_path() / name);
    }
    return files;
}

std::vector<fs::path> modelFilesOf(const brittle::SceneDescription& scene, const fs::path& folder) {
    std::vector<fs::path> files;
    const auto add = [&](const brittle::ShapeDescription& shape) {
        if (shape.file.empty()) return;
        for (fs::path& file : filesOfModel(folder / shape.file))
            files.push_back(std::move(file));
    };
    for (const brittle::BodyDescription& body : scene.bodies)
        add(body.shape);
    for (const brittle::ColliderDescription& collider : scene.colliders)
        add(collider.shape);
    return files;
}

std::vector<fs::path> filesOfScene(const std::string& source, const brittle::SceneDescription& scene) {
    std::vector<fs::path> files = modelFilesOf(scene, folderOf(source));
    files.emplace_back(source);
    return files;
}

engine::Result<void> checkIsNoInput(const std::string& output, const std::vector<fs::path>& inputs) {
    for (const fs::path& input : inputs)
        if (sameFile(output, input.string()))
            return engine::Error{engine::ErrorCode::BadInput,
                                 output + ": is read as input and would be overwritten; write to another file"};
    return {};
}

} // namespace cli
