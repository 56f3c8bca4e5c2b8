#include "tools/brittle/event_report.h"

#include "modules/brittle/dynamics/count_names.h"
#include "modules/brittle/dynamics/sector_place.h"
#include "modules/brittle/mesh/format.h"
#include "shaders-spirv/shared/breaking.h"
#include "tools/brittle/body_cast.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kLines = 12;
constexpr const char* kWhy[] = {"",
                                "no room in the world",
                                "too dear for the blow",
                                "in one piece",
                                "the cutting failed",
                                "too large for a step",
                                "no room for pairs"};
constexpr const char *kPools[] = {"bodies", "pieces", "faces", "triangles"}, *kLists[] = {"pairs", "contacts", "", ""},
                     *kOfAStep[] = {"breaking_triangles", "breaking_sites", "", ""};

struct Who {
    uint32_t slot = 0, born = 0, origin = 0;
};

Who struckOf(const gpu::BreakEvent& event) { return {event.what.y, event.born.x, event.born.z}; }
Who strikerOf(const gpu::BreakEvent& event) { return {event.what.z, event.born.y, event.born.w}; }
Who firstOf(const gpu::ImpactEvent& event) { return {event.what.y, event.born.x, event.born.z}; }
Who secondOf(const gpu::ImpactEvent& event) { return {event.what.z, event.born.y, event.born.w}; }

// Nobody goes without a name but a hand.
std::string nameOf(const Who& who, const EventReport& report) {
    if (who.origin >= report.names.size()) return "by hand";
    const std::string& origin = report.names[who.origin];
    return who.born == 0 ? origin : fragmentName(origin, who.born, who.slot);
}

Json materialOf(const Who& who, const EventReport& report) {
    const bool is_known = who.origin < report.materials.size() && !report.materials[who.origin].empty();
    return is_known ? Json(report.materials[who.origin]) : Json();
}

const char* whyOf(const gpu::BreakEvent& event) { return kWhy[std::min<size_t>(event.made.y, std::size(kWhy) - 1)]; }

std::array<double, 3> normalOf(const gpu::vec4& along) { return {along.x, along.y, along.z}; }

// What there was none left of, and how much of it was wanted.
std::vector<std::pair<std::string, uint32_t>> lackedBy(const gpu::BreakEvent& event) {
    if (event.made.y == WHOLE_FAILED && event.made.w != 0) return {{brittle::nameOfFractureCount(event.made.z), event.made.w}};
    const auto& names = event.made.y == WHOLE_NO_PAIRS ? kLists : event.made.y == WHOLE_TOO_LARGE ? kOfAStep : kPools;
    const uint32_t lacked[] = {event.lacked.x, event.lacked.y, event.lacked.z, event.lacked.w};
    std::vector<std::pair<std::string, uint32_t>> pools;
    for (size_t k = 0; k < std::size(kPools); ++k)
        if (lacked[k] != 0) pools.emplace_back(names[k], lacked[k]);
    return pools;
}

// Of two that break each other the first tells what both have paid.
void addOutcome(Json& json, const gpu::BreakEvent& event, const EventReport& report) {
    json["largest_mass"] = event.sizes.x;
    json["smallest_mass"] = event.sizes.y;
    json["dust"] = {{"cells", event.sector.w}, {"mass", event.offset.w}};
    json["crack_area"] = event.energies.w;
    if (event.made.z != 0) {
        json["paid_by"] = nameOf(strikerOf(event), report);
        return;
    }
    json["crack_energy"] = event.energies.z;
    json["impulse"] = event.blow.w;
    json["energy_before"] = event.energies.x;
    json["energy_after"] = event.energies.y;
}

Json toJson(const gpu::BreakEvent& event, const EventReport& report) {
    Json json = {{"step", event.what.x},
                 {"seconds", event.what.x * report.dt},
                 {"body", nameOf(struckOf(event), report)},
                 {"hit_by", nameOf(strikerOf(event), report)},
                 {"material", materialOf(struckOf(event), report)},
                 {"place", brittle::placeOf(event.sector, event.offset)},
                 {"normal", normalOf(event.along)},
                 {"effective_mass", event.blow.x},
                 {"speed", event.blow.y},
                 {"fragments_paid_for", event.along.w},
                 {"fragments", event.made.x}};
    if (event.made.y == 0) {
        addOutcome(json, event, report);
        return json;
    }
    json["whole"] = whyOf(event);
    for (const auto& [pool, lacked] : lackedBy(event))
        json["lacked"][pool] = lacked;
    return json;
}

bool isGone(const gpu::BreakEvent& event) { return event.made.y == WHOLE_GONE; }

std::vector<gpu::BreakEvent> blowsOf(const EventReport& report) {
    std::vector<gpu::BreakEvent> blows = report.breaks.events;
    std::erase_if(blows, isGone);
    return blows;
}

Json goneToJson(const gpu::BreakEvent& event, const EventReport& report) {
    return {{"step", event.what.x},
            {"seconds", event.what.x * report.dt},
            {"body", nameOf(struckOf(event), report)},
            {"place", brittle::placeOf(event.sector, event.offset)}};
}

Json toJson(const gpu::ImpactEvent& event, const EventReport& report) {
    return {{"step", event.what.x},
            {"seconds", event.what.x * report.dt},
            {"bodies", {nameOf(firstOf(event), report), nameOf(secondOf(event), report)}},
            {"materials", {materialOf(firstOf(event), report), materialOf(secondOf(event), report)}},
            {"place", brittle::placeOf(event.sector, event.offset)},
            {"normal", normalOf(event.along)},
            {"effective_mass", event.measures.x},
            {"speed", event.measures.y},
            {"energy", event.measures.z},
            {"impulse", event.measures.w}};
}

template <class Event>
Json listOf(const std::vector<Event>& events, const EventReport& report) {
    Json list = Json::array();
    for (const Event& event : events)
        list.push_back(toJson(event, report));
    return list;
}

std::string tooSmallOf(const gpu::BreakEvent& event) {
    if (event.sector.w == 0) return {};
    return ", " + std::to_string(event.sector.w) + " cells too small for bodies, " +
           brittle::formatNumber(double{event.offset.w}) + " kg";
}

std::string fragmentsOf(const gpu::BreakEvent& event) {
    const auto paid = static_cast<uint32_t>(event.along.w);
    const bool is_cut_short = event.made.x + static_cast<uint32_t>(event.sector.w) < paid / 2;
    const std::string of = is_cut_short ? " of " + std::to_string(paid) + " that the blow pays for" : "";
    return std::to_string(event.made.x) + " fragments" + of;
}

std::string outcomeOf(const gpu::BreakEvent& event) {
    if (event.made.y == 0)
        return fragmentsOf(event) + ", " + brittle::formatNumber(double{event.energies.w}) + " m2 of crack" + tooSmallOf(event);
    std::string text = std::string("whole: ") + whyOf(event);
    for (const auto& [pool, lacked] : lackedBy(event))
        text += ", lacked " + std::to_string(lacked) + " " + pool;
    return text;
}

void printBreaks(const EventReport& report) {
    const std::vector<gpu::BreakEvent> events = blowsOf(report);
    const char* heading = "breaks";
    for (size_t k = 0; k < std::min(events.size(), kLines); ++k) {
        const gpu::BreakEvent& event = events[k];
        std::printf("%-10s %7.3f s  %s by %s at %s m/s: %s\n", heading, event.what.x * report.dt,
                    nameOf(struckOf(event), report).c_str(), nameOf(strikerOf(event), report).c_str(),
                    brittle::formatNumber(double{event.blow.y}).c_str(), outcomeOf(event).c_str());
        heading = "";
    }
    if (events.size() > kLines) std::printf("%-10s and %zu more; --json has them all\n", "", events.size() - kLines);
    if (report.breaks.lost != 0)
        std::printf("%-10s %u were lost: more broke in a step than the device keeps\n", "", report.breaks.lost);
}

void printImpacts(const EventReport& report) {
    const std::vector<gpu::ImpactEvent>& events = report.impacts.events;
    if (events.empty()) return;
    const auto energyOf = [](const gpu::ImpactEvent& event) { return event.measures.z; };
    const gpu::ImpactEvent& hardest = *std::ranges::max_element(events, {}, energyOf);
    std::printf("impacts    %zu, the hardest at %.3f s: %s and %s at %s m/s, %s J\n", events.size(), hardest.what.x * report.dt,
                nameOf(firstOf(hardest), report).c_str(), nameOf(secondOf(hardest), report).c_str(),
                brittle::formatNumber(double{hardest.measures.y}).c_str(),
                brittle::formatNumber(double{hardest.measures.z}).c_str());
}

} // namespace

Json breaksJson(const EventReport& report) { return listOf(blowsOf(report), report); }
Json goneJson(const EventReport& report) {
    Json list = Json::array();
    for (const gpu::BreakEvent& event : report.breaks.events)
        if (isGone(event)) list.push_back(goneToJson(event, report));
    return list;
}
Json impactsJson(const EventReport& report) { return listOf(report.impacts.events, report); }

void printEvents(const EventReport& report) {
    printBreaks(report);
    printImpacts(report);
}

} // namespace cli
