// The table of keys as something to read.
#include "modules/brittle/scene/scene_keys.h"

#include <sstream>

namespace brittle {
namespace {

std::string shapesOf(const SceneKey& key) {
    if (key.shapes == kEveryShape) return "";
    std::string text;
    for (size_t k = 0; k < shapeNames().size(); ++k)
        if (key.shapes >> k & 1) text += (text.empty() ? "" : " or ") + std::string(shapeNames()[k]);
    return text + ": ";
}

std::string sentence(const SceneKey& key) { return shapesOf(key) + std::string(key.meaning); }

// As a file would have it.
std::string defaultText(const SceneSection& section, const SceneKey& key) {
    const std::string text = formatValue(defaultOf(section, key), key.allowed);
    return text.empty() || text == "\"\"" || text == "[]" ? "" : text;
}

} // namespace

std::string sceneKeyReference() {
    std::ostringstream text;
    for (const SceneSection& section : sceneSections()) {
        text << (section.id == SectionId::Scene ? "" : "\n") << "### "
             << (section.name.empty() ? "Top of the file" : "`" + headingOf(section) + "`") << "\n\n"
             << section.meaning << "\n\n| key | default | has to be | meaning |\n|---|---|---|---|\n";
        for (const SceneKey& key : section.keys) {
            const std::string usual = defaultText(section, key);
            text << "| `" << key.name << "` | " << (usual.empty() ? "" : "`" + usual + "`") << " | " << describeAllowed(key)
                 << " | " << sentence(key) << " |\n";
        }
    }
    return text.str();
}

std::string sceneKeyHelp() {
    std::ostringstream text;
    for (const SceneSection& section : sceneSections()) {
        text << (section.name.empty() ? "At the top of the file" : headingOf(section)) << "\n";
        for (const SceneKey& key : section.keys) {
            const std::string usual = defaultText(section, key);
            text << "  " << key.name << std::string(key.name.size() < 16 ? 16 - key.name.size() : 1, ' ') << sentence(key)
                 << "\n"
                 << std::string(18, ' ') << describeAllowed(key) << (usual.empty() ? "" : "; usually " + usual) << "\n";
        }
        text << "\n";
    }
    return text.str();
}

} // namespace brittle
