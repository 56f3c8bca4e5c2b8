#include "tools/device_check/check_summary.h"

namespace device_check {
namespace {

constexpr uint64_t kFullBelow = 1 << 20; // bytes

std::string shareOf(const Json& part) {
    if (part["status"] == "skipped") return "skipped";
    const size_t unlisted = part.value("unlisted", size_t{0});
    const std::string programs = unlisted == 0 ? "" : std::to_string(unlisted) + " programs with tests unknown";
    if (!part.contains("of") || part["of"] == 0) return programs.empty() ? "not reached" : programs;
    return std::to_string(part["done"].get<size_t>()) + " of " + std::to_string(part["of"].get<size_t>()) +
           (programs.empty() ? "" : ", " + programs);
}

// A part without `of` has nothing to count: it is whole if it passed.
bool isWhole(const Json& part) {
    if (part["status"] == "skipped" || part["status"] == "stopped" || part.value("unlisted", size_t{0}) > 0) return false;
    if (!part.contains("of")) return part["status"] == "passed";
    return part["of"] != 0 && part["done"] == part["of"];
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
