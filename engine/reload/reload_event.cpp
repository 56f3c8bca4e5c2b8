#include "engine/reload/reload_event.h"

#include <cstdio>

namespace engine {
namespace {

constexpr size_t kMostNames = 6;

std::string timesOf(const ReloadEvent& event) {
    char text[96];
    if (event.at_start)
        std::snprintf(text, sizeof text, " (as the folder had them at the start)");
    else
        std::snprintf(text, sizeof text, ", %.0f ms after the save (compiled in %.0f ms)", event.since_save_ms,
                      event.compiling_ms);
    return text;
}

} // namespace

std::string listOf(const std::vector<std::string>& kernels) {
    std::string text;
    for (size_t k = 0; k < kernels.size() && k < kMostNames; ++k)
        text += (k == 0 ? "" : ", ") + kernels[k];
    if (kernels.size() > kMostNames) text += " and " + std::to_string(kernels.size() - kMostNames) + " more";
    return text;
}

std::string textOf(const ReloadEvent& event) {
    const std::string names = listOf(event.kernels);
    switch (event.kind) {
    case ReloadEvent::Kind::Reloaded: return "reloaded " + names + timesOf(event);
    case ReloadEvent::Kind::Checked:
        return "checked " + names + ": sound" + (event.at_start ? "" : "; nothing that runs here uses it");
    case ReloadEvent::Kind::Unchanged: return "unchanged " + names + ": compiles to what it was";
    case ReloadEvent::Kind::Refused:
        if (!event.runs) return "refused " + names + "; nothing that runs here uses it";
        return "kept the last good " + names + (event.waiting.empty() ? "" : "; waiting for it: " + listOf(event.waiting));
    case ReloadEvent::Kind::Trouble: break;
    }
    return event.message;
}

} // namespace engine
