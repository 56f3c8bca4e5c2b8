#include "tools/compare/compare_report.h"

#include "modules/brittle/mesh/format.h"

#include <cstdio>

namespace compare {
namespace {

using brittle::BufferDifference;
using brittle::DifferenceKind;
using brittle::ValueDifference;
using Json = nlohmann::ordered_json;

std::string bodyName(const CompareReport& report, uint32_t body) {
    return body < report.bodies.size() ? report.bodies[body] : "fragment in slot " + std::to_string(body);
}

Json toJson(const ComparedDevice& device) { return {{"name", device.name}, {"driver", device.driver}}; }

Json toJson(const ValueDifference& value) {
    return {{"element_a", value.element_a},
            {"element_b", value.element_b},
            {"member", value.member},
            {"type", value.type},
            {"a", value.a},
            {"b", value.b},
            {"bits_a", value.bits_a},
            {"bits_b", value.bits_b}};
}

Json toJson(const BufferDifference& row) {
    return {{"kind", nameOf(row.kind)},
            {"pass_a", row.pass_a},
            {"pass_b", row.pass_b},
            {"stage", row.stage},
            {"kernel_a", row.kernel_a},
            {"kernel_b", row.kernel_b},
            {"slot", row.slot},
            {"buffer", row.buffer},
            {"differing", row.differing},
            {"written", row.written},
            {"first", row.first ? toJson(*row.first) : Json()}};
}

Json toJson(const brittle::TracedStep& traced) {
    const BufferDifference* finding = traced.comparison.finding();
    Json rows = Json::array();
    for (const BufferDifference& row : traced.comparison.rows)
        rows.push_back(toJson(row));
    return {{"step", traced.step},
            {"from_same_state", traced.from_same_state},
            {"passes_a", traced.comparison.passes_a},
            {"passes_b", traced.comparison.passes_b},
            {"aligned", traced.comparison.aligned},
            {"finding", finding != nullptr ? toJson(*finding) : Json()},
            {"rows", rows},
            {"cut", traced.comparison.is_cut}};
}

Json bodyJson(const CompareReport& report) {
    if (!report.found.first_difference || !report.found.body) return {};
    const brittle::BodyDifference& body = *report.found.body;
    return {{"step", *report.found.first_difference},
            {"body", body.body},
            {"name", bodyName(report, body.body)},
            {"member", body.member},
            {"a", body.a},
            {"b", body.b}};
}

Json toJson(const brittle::MotionDifference& motion) {
    return {{"position_m", motion.position_m},
            {"rotation_rad", motion.rotation_rad},
            {"linear_velocity", motion.linear_velocity},
            {"body", motion.body},
            {"bodies", motion.bodies},
            {"only_a", motion.only_a},
            {"only_b", motion.only_b}};
}

std::string kernelOf(const BufferDifference& row) {
    return row.kernel_a == row.kernel_b ? row.kernel_a : row.kernel_a + " / " + row.kernel_b;
}

std::string slotOf(const BufferDifference& row) { return row.slot.empty() ? row.buffer : row.slot; }

std::string countOf(const BufferDifference& row) {
    return row.written == 0 ? "" : std::to_string(row.differing) + " of " + std::to_string(row.written);
}

// Words may be floats: both views are shown.
std::string valuesOf(const ValueDifference& value) { return value.member + " " + value.type + " " + value.a + " | " + value.b; }

void printRow(const BufferDifference& row, bool is_finding) {
    const std::string value = row.first ? valuesOf(*row.first) : "";
    std::printf("%c %4u  %-16s %-20s %-18s %-9s %14s  %s\n", is_finding ? '>' : ' ', row.pass_a, row.stage.c_str(),
                kernelOf(row).c_str(), slotOf(row).c_str(), std::string(nameOf(row.kind)).c_str(), countOf(row).c_str(),
                value.c_str());
}

// Rows of the finding's kind; without a finding, those that a device does not repeat.
std::vector<const BufferDifference*> shownRows(const brittle::StepComparison& comparison) {
    constexpr size_t kMostShown = 20;
    const DifferenceKind kind = comparison.finding() != nullptr ? DifferenceKind::Differs : DifferenceKind::Unstable;
    std::vector<const BufferDifference*> rows;
    for (const BufferDifference& row : comparison.rows)
        if (row.kind == kind && rows.size() < kMostShown) rows.push_back(&row);
    return rows;
}

void printRows(const brittle::StepComparison& comparison) {
    const auto rows = shownRows(comparison);
    if (!rows.empty())
        std::printf("\n  pass  %-16s %-20s %-18s %-9s %14s  first value, A | B\n", "stage", "kernel", "buffer", "kind",
                    "elements");
    for (const BufferDifference* row : rows)
        printRow(*row, row == comparison.finding());
    if (comparison.is_cut) std::printf("        later passes are left out\n");
    if (!rows.empty()) std::printf("\n");
    if (const size_t others = comparison.rows.size() - rows.size(); others > 0)
        std::printf("order      %s in another order or not repeated; --json lists them\n",
                    brittle::formatCount(others, "buffer is", "buffers are").c_str());
}

void printFinding(const BufferDifference& row) {
    std::printf("first      kernel %s, stage %s, pass %u, buffer %s", kernelOf(row).c_str(), row.stage.c_str(), row.pass_a,
                slotOf(row).c_str());
    if (row.buffer != slotOf(row)) std::printf(" (%s)", row.buffer.c_str());
    std::printf("\n");
    if (!row.first) return;
    const ValueDifference& value = *row.first;
    std::printf("           %s, %s: A %s (%s), B %s (%s)\n", value.member.c_str(), value.type.c_str(), value.a.c_str(),
                value.bits_a.c_str(), value.b.c_str(), value.bits_b.c_str());
    if (value.element_a != value.element_b)
        std::printf("           element %llu on A is compared with element %llu on B: the list has another order\n",
                    static_cast<unsigned long long>(value.element_a), static_cast<unsigned long long>(value.element_b));
}

void printTraced(const brittle::TracedStep& traced) {
    const brittle::StepComparison& comparison = traced.comparison;
    std::printf("step %-5u %u passes on A, %u on B, %u on both; both began with %s\n", traced.step, comparison.passes_a,
                comparison.passes_b, comparison.aligned, traced.from_same_state ? "the state of device A" : "their own state");
    printRows(comparison);
    if (comparison.finding() != nullptr)
        printFinding(*comparison.finding());
    else
        std::printf("first      no pass computes other values\n");
}

} // namespace

Json compareJson(const CompareReport& report) {
    const Json traced = report.found.traced ? toJson(*report.found.traced) : Json();
    return {{"scene", report.scene},
            {"device_a", toJson(report.a)},
            {"device_b", toJson(report.b)},
            {"steps", report.found.steps},
            {"seconds", report.found.steps * report.dt},
            {"agree", report.agrees()},
            {"first_difference", bodyJson(report)},
            {"passes", traced},
            {"motion", toJson(report.found.motion)}};
}

void printCompare(const CompareReport& report) {
    const brittle::WorldComparison& found = report.found;
    std::printf("scene      %s\ndevice A   %s, %s\ndevice B   %s, %s\n", report.scene.c_str(), report.a.name.c_str(),
                report.a.driver.c_str(), report.b.name.c_str(), report.b.driver.c_str());
    if (!found.first_difference)
        std::printf("bodies     are the same bit for bit after each of %u steps\n", found.steps);
    else if (found.body)
        std::printf("bodies     differ after step %u: body %u \"%s\", %s: A %s, B %s\n", *found.first_difference,
                    found.body->body, bodyName(report, found.body->body).c_str(), found.body->member.c_str(),
                    found.body->a.c_str(), found.body->b.c_str());
    if (found.traced) printTraced(*found.traced);
    const brittle::MotionDifference& motion = found.motion;
    std::printf("motion     after %u steps, %s s, the largest differences of %u bodies: %s m, %s rad, %s m/s\n", found.steps,
                brittle::formatNumber(found.steps * report.dt).c_str(), motion.bodies,
                brittle::formatNumber(motion.position_m).c_str(), brittle::formatNumber(motion.rotation_rad).c_str(),
                brittle::formatNumber(motion.linear_velocity).c_str());
    if (motion.only_a + motion.only_b > 0)
        std::printf("           %u bodies exist on A alone, %u on B alone\n", motion.only_a, motion.only_b);
}

} // namespace compare
