#include "tools/brittle/plan_report.h"

#include <algorithm>
#include <cstdio>
#include <optional>

namespace cli {
namespace {

using brittle::Effect;
using brittle::Pass;
using brittle::PassBuffer;
using brittle::PassSize;
using brittle::PlannedBuffer;

std::string askedBy(const std::optional<Effect>& effect) { return effect ? std::string(nameOf(*effect)) : "every world"; }

// Fills and copies are not timed.
std::vector<double> timesOf(const PlanReport& report) {
    std::vector<double> us;
    size_t next = 0;
    for (const Pass& pass : report.plan.passes) {
        const bool is_timed = pass.isDispatch() && next < report.us.size();
        us.push_back(is_timed ? report.us[next] : 0);
        next += pass.isDispatch() ? 1 : 0;
    }
    return us;
}

std::string accessOf(const PassBuffer& buffer) {
    if (!buffer.writes) return "reads";
    return buffer.reads ? "updates" : "writes";
}

std::string groupsOf(const Pass& pass) {
    const std::string size(nameOf(pass.size));
    switch (pass.size) {
    case PassSize::Lanes: return std::to_string(pass.count) + (pass.count == 1 ? " lane" : " lanes");
    case PassSize::Groups: return std::to_string(pass.count) + (pass.count == 1 ? " group" : " groups");
    case PassSize::Arguments: return "by " + pass.counted_by;
    default: return size + ": " + pass.counted_by;
    }
}

std::string constantsOf(const Pass& pass) {
    std::string text;
    for (const auto& [name, value] : pass.constants)
        text += (text.empty() ? "" : ", ") + name + " " + std::to_string(value);
    return text;
}

// ---- for people -----------------------------------------------------------------------------------------------------------

// Passes that come again and again, by substeps and colors, are one row, where they come first.
struct Row {
    const Pass* pass;
    uint32_t times = 0;
    double us = 0;
};

bool isSameRow(const Pass& a, const Pass& b) {
    const bool both_colors = a.counted_by.starts_with("contacts of color") && b.counted_by.starts_with("contacts of color");
    return a.stage == b.stage && a.kernel == b.kernel && a.size == b.size && a.count == b.count && a.buffers == b.buffers &&
           (both_colors || a.counted_by == b.counted_by);
}

std::vector<Row> rowsOf(const PlanReport& report) {
    std::vector<Row> rows;
    const std::vector<double> us = timesOf(report);
    for (size_t k = 0; k < us.size(); k++) {
        const Pass& pass = report.plan.passes[k];
        auto row = std::ranges::find_if(rows, [&](const Row& r) { return isSameRow(*r.pass, pass); });
        if (row == rows.end()) row = rows.insert(rows.end(), {&pass});
        row->times++;
        row->us += us[k];
    }
    return rows;
}

// Of memory that lists share, which of them it is.
std::string nameOf(const PassBuffer& buffer, const brittle::StepPlan& plan) {
    const auto named = std::ranges::find(plan.buffers, buffer.buffer, &PlannedBuffer::name);
    const bool is_shared = named != plan.buffers.end() && named->is_shared && !buffer.slot.empty();
    return is_shared ? buffer.buffer + "/" + buffer.slot : buffer.buffer;
}

void printAccesses(const Pass& pass, const brittle::StepPlan& plan) {
    for (const char* access : {"reads", "updates", "writes"}) {
        std::string names;
        for (const PassBuffer& buffer : pass.buffers)
            if (accessOf(buffer) == access) names += (names.empty() ? " " : ", ") + nameOf(buffer, plan);
        if (!names.empty()) std::printf("          %s%s\n", access, names.c_str());
    }
}

void printPasses(const PlanReport& report) {
    const auto dispatches = std::ranges::count_if(report.plan.passes, &Pass::isDispatch);
    std::printf("\npasses of a step, in order: %zu dispatches, %zu fills and copies\n", static_cast<size_t>(dispatches),
                report.plan.passes.size() - static_cast<size_t>(dispatches));
    std::string stage;
    for (const Row& row : rowsOf(report)) {
        const Pass& pass = *row.pass;
        if (pass.stage != stage) std::printf("  %s\n", pass.stage.c_str());
        stage = pass.stage;
        std::printf("    %-22s %3ux", pass.kernel.c_str(), row.times);
        if (pass.isDispatch()) std::printf("  %s", groupsOf(pass).c_str());
        if (!pass.constants.empty()) std::printf("  (%s)", constantsOf(pass).c_str());
        if (report.is_measured && pass.isDispatch()) std::printf("  %.1f us", row.us);
        std::printf("\n");
        printAccesses(pass, report.plan);
    }
}

void printBuffers(const PlanReport& report) {
    std::printf("\n%-28s %14s  asked for by\n", "buffers", "bytes");
    for (const PlannedBuffer& buffer : report.plan.buffers)
        std::printf("  %-26s %14llu  %s\n", buffer.name.c_str(), static_cast<unsigned long long>(buffer.bytes),
                    askedBy(buffer.asked_by).c_str());
    std::printf("\n%-28s %14s\n", "in all", "bytes");
    std::printf("  %-26s %14llu\n", "every world", static_cast<unsigned long long>(report.plan.bytesOf(std::nullopt)));
    for (const Effect effect : report.plan.effects.list())
        std::printf("  %-26s %14llu\n", askedBy(effect).c_str(), static_cast<unsigned long long>(report.plan.bytesOf(effect)));
    std::printf("  %-26s %14llu\n", "sum", static_cast<unsigned long long>(report.plan.bytes()));
}

// ---- for programs ---------------------------------------------------------------------------------------------------------

nlohmann::ordered_json jsonOf(const Pass& pass) {
    nlohmann::ordered_json constants = nlohmann::ordered_json::object(), buffers = nlohmann::ordered_json::array();
    for (const auto& [name, value] : pass.constants)
        constants[name] = value;
    for (const PassBuffer& buffer : pass.buffers)
        buffers.push_back({{"slot", buffer.slot}, {"buffer", buffer.buffer}, {"access", accessOf(buffer)}});
    nlohmann::ordered_json json = {{"stage", pass.stage}, {"kernel", pass.kernel}, {"size", nameOf(pass.size)}};
    if (pass.counted_by.empty())
        json["count"] = pass.count;
    else
        json["counted_by"] = pass.counted_by;
    json["constants"] = constants;
    json["buffers"] = buffers;
    return json;
}

nlohmann::ordered_json passesJson(const PlanReport& report) {
    nlohmann::ordered_json passes = nlohmann::ordered_json::array();
    const std::vector<double> us = timesOf(report);
    for (size_t k = 0; k < us.size(); k++) {
        passes.push_back(jsonOf(report.plan.passes[k]));
        if (report.is_measured && report.plan.passes[k].isDispatch()) passes.back()["us"] = us[k];
    }
    return passes;
}

} // namespace

nlohmann::ordered_json planJson(const PlanReport& report) {
    nlohmann::ordered_json effects = nlohmann::ordered_json::array(), buffers = nlohmann::ordered_json::array();
    nlohmann::ordered_json bytes = {{"every world", report.plan.bytesOf(std::nullopt)}};
    for (const PlannedEffect& effect : report.effects) {
        effects.push_back({{"name", effect.name}});
        if (!effect.called_by.empty()) effects.back()["called_by"] = effect.called_by;
    }
    for (const PlannedBuffer& buffer : report.plan.buffers)
        buffers.push_back({{"name", buffer.name},
                           {"bytes", buffer.bytes},
                           {"asked_by", askedBy(buffer.asked_by)},
                           {"shared", buffer.is_shared}});
    for (const Effect effect : report.plan.effects.list())
        bytes[std::string(nameOf(effect))] = report.plan.bytesOf(effect);
    bytes["sum"] = report.plan.bytes();
    return {{"scene", report.scene},         {"device", report.device}, {"effects", effects},
            {"passes", passesJson(report)},  {"buffers", buffers},      {"bytes", bytes},
            {"kernels", report.plan.kernels}};
}

void printPlan(const PlanReport& report) {
    std::printf("scene      %s\ndevice     %s\n", report.scene.c_str(), report.device.c_str());
    const char* heading = "effects";
    for (const PlannedEffect& effect : report.effects) {
        const std::string why = effect.called_by.empty() ? "" : " (called for by " + effect.called_by + ")";
        std::printf("%-10s %s%s\n", heading, effect.name.c_str(), why.c_str());
        heading = "";
    }
    printPasses(report);
    printBuffers(report);
    std::printf("\nkernels that are loaded\n ");
    for (const std::string& kernel : report.plan.kernels)
        std::printf(" %s", kernel.c_str());
    std::printf("\n");
}

} // namespace cli
