#include "tools/brittle/break_report.h"

#include "modules/brittle/mesh/format.h"
#include "shaders-spirv/shared/body.h"
#include "shaders-spirv/shared/breaking.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kLines = 12;
constexpr const char* kWhy[] = {
    "", "no room in the world", "too dear for the blow", "in one piece", "the cutting failed", "too large for a step"};
constexpr const char* kPools[] = {"bodies", "pieces", "faces", "triangles"};

std::string nameOf(uint32_t body, const BreakReport& report) {
    const bool has_name = body < report.names.size() && !report.names[body].empty();
    return has_name ? report.names[body] : std::to_string(body);
}

const char* whyOf(const gpu::BreakEvent& event) { return kWhy[std::min<size_t>(event.made.y, std::size(kWhy) - 1)]; }

std::array<double, 3> placeOf(const gpu::BreakEvent& event) {
    const auto along = [](int32_t sector, float offset) { return double{SECTOR_EDGE} * sector + double{offset}; };
    return {along(event.sector.x, event.offset.x), along(event.sector.y, event.offset.y),
            along(event.sector.z, event.offset.z)};
}

// What there was none left of, and how much of it was wanted.
std::vector<std::pair<std::string, uint32_t>> lackedBy(const gpu::BreakEvent& event) {
    const uint32_t lacked[] = {event.lacked.x, event.lacked.y, event.lacked.z, event.lacked.w};
    std::vector<std::pair<std::string, uint32_t>> pools;
    for (size_t k = 0; k < std::size(kPools); ++k)
        if (lacked[k] != 0) pools.emplace_back(kPools[k], lacked[k]);
    return pools;
}

Json toJson(const gpu::BreakEvent& event, const BreakReport& report) {
    Json json = {{"step", event.what.x},
                 {"seconds", event.what.x * report.dt},
                 {"body", nameOf(event.what.y, report)},
                 {"hit_by", nameOf(event.what.z, report)},
                 {"place", placeOf(event)},
                 {"effective_mass", event.blow.x},
                 {"speed", event.blow.y},
                 {"fragments", event.made.x}};
    if (event.made.y != 0) {
        json["whole"] = whyOf(event);
        for (const auto& [pool, lacked] : lackedBy(event))
            json["lacked"][pool] = lacked;
        return json;
    }
    json["too_small"] = {{"cells", event.sector.w}, {"mass", event.offset.w}};
    json["crack_area"] = event.energies.w;
    json["crack_energy"] = event.energies.z;
    json["impulse"] = event.blow.w;
    json["energy_before"] = event.energies.x;
    json["energy_after"] = event.energies.y;
    return json;
}

std::string tooSmallOf(const gpu::BreakEvent& event) {
    if (event.sector.w == 0) return {};
    return ", " + std::to_string(event.sector.w) + " cells too small for bodies, " +
           brittle::formatNumber(double{event.offset.w}) + " kg";
}

std::string outcomeOf(const gpu::BreakEvent& event) {
    if (event.made.y == 0)
        return std::to_string(event.made.x) + " fragments, " + brittle::formatNumber(double{event.energies.w}) +
               " m2 of crack" + tooSmallOf(event);
    std::string text = std::string("whole: ") + whyOf(event);
    for (const auto& [pool, lacked] : lackedBy(event))
        text += ", lacked " + std::to_string(lacked) + " " + pool;
    return text;
}

} // namespace

Json breaksJson(const BreakReport& report) {
    Json events = Json::array();
    for (const gpu::BreakEvent& event : report.events)
        events.push_back(toJson(event, report));
    return events;
}

void printBreaks(const BreakReport& report) {
    const char* heading = "breaks";
    for (size_t k = 0; k < std::min(report.events.size(), kLines); ++k) {
        const gpu::BreakEvent& event = report.events[k];
        std::printf("%-10s %7.3f s  %s by %s at %s m/s: %s\n", heading, event.what.x * report.dt,
                    nameOf(event.what.y, report).c_str(), nameOf(event.what.z, report).c_str(),
                    brittle::formatNumber(double{event.blow.y}).c_str(), outcomeOf(event).c_str());
        heading = "";
    }
    if (report.events.size() > kLines)
        std::printf("%-10s and %zu more; --json has them all\n", "", report.events.size() - kLines);
    if (report.lost != 0) std::printf("%-10s %u were lost: more broke in a step than the device keeps\n", "", report.lost);
}

} // namespace cli
