#include "tools/device_check/check_summary.h"

namespace device_check {
namespace {

constexpr uint64_t kFullBelow = 1 << 20; // bytes

std::string shareOf(const Json& part) {
    if (part["status"] == "skipped") return "skipped";
    if (!part.contains("of") || part["of"] == 0) return "not reached";
    return std::to_string(part["done"].get<size_t>()) + " of " + std::to_string(part["of"].get<size_t>());
}

bool isWhole(const Json& part) {
    if (part["status"] == "passed") return true;
    return part["status"] == "failed" && part.value("done", size_t{0}) == part.value("of", size_t{0});
}

} // namespace

std::string uncheckedIn(const Json& parts) {
    std::string list;
    for (const auto& [name, part] : parts.items())
        if (!isWhole(part)) list += (list.empty() ? "" : ", ") + part["title"].get<std::string>() + " (" + shareOf(part) + ")";
    return list.empty() ? "" : "These parts were not checked, or not wholly: " + list + ".";
}

uint64_t freeBytes(const std::filesystem::path& folder) {
    std::error_code unknown;
    const std::filesystem::space_info space = std::filesystem::space(folder, unknown);
    return unknown ? 0 : space.available;
}

void excuseFullDisk(Json& outcome, const std::filesystem::path& folder) {
    if (outcome["status"] != "failed" || outcome.contains("differing") || freeBytes(folder) >= kFullBelow) return;
    outcome["status"] = "stopped";
    outcome["reason"] = "the disk is full, so this says nothing about the device: " + outcome.value("reason", "");
}

} // namespace device_check
