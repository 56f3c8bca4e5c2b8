// Hostile bytes as a scene file. What the sanitizers see is theirs to tell. On top of that: a refusal is one line that names
// the file and the line, and what is read is sound and, written, is read as the same.
#include "modules/brittle/scene/check_scene.h"
#include "modules/brittle/scene/scene_file.h"
#include "tests/fuzz/require.h"

using namespace brittle;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const auto scene = readScene(std::string_view(reinterpret_cast<const char*>(data), size), "scene.toml");
    if (!scene) {
        require(scene.error().message.starts_with("scene.toml:"), "an error says where");
        require(scene.error().message.find('\n') == std::string::npos, "an error is one line");
        return 0;
    }
    require(checkScene(*scene).has_value(), "what is read is sound");
    const auto again = readScene(writeScene(*scene), "again.toml");
    require(again.has_value(), "what is written is read");
    require(*again == *scene, "what is written is read as the same");
    return 0;
}
