// brittle hard: its options, its table, and what it writes.
#include "tools/accuracy/machine.h"
#include "tools/accuracy/result_files.h"
#include "tools/brittle/command.h"
#include "tools/brittle/progress.h"
#include "tools/hard/hard_run.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iterator>
#include <memory>

namespace cli {
namespace {

namespace fs = std::filesystem;

using accuracy::HardCase, accuracy::Results;
using engine::Result;

struct HardOptions {
    hard::RunOptions run;
    std::string folder, device;
    bool list = false;
};

const char* verdictOf(const HardCase& one) {
    if (!one.has_passed) return "FAILS";
    return one.is_known_shortfall ? "short" : "passes";
}

void printHead() {
    std::printf("%-46s %-13s %-6s %10s %10s  %-44s %7s %9s\n", "case", "setting", "", "worst", "allowed", "of", "exact", "ms");
}

void printRow(const HardCase& one) {
    const std::string what = one.why.empty() ? one.worst_kind + (one.unit.empty() ? "" : ", " + one.unit) : one.why;
    if (one.why.empty())
        std::printf("%-46s %-13s %-6s %10.3g %10.3g  %-44s %7.0f %9.1f\n", one.name.c_str(), one.setting.c_str(),
                    verdictOf(one), one.worst_error, one.allowed, what.c_str(), one.exact_tests, one.ms);
    else
        std::printf("%-46s %-13s %-6s %s\n", one.name.c_str(), one.setting.c_str(), verdictOf(one), what.c_str());
    std::fflush(stdout);
}

bool isBullet(const HardCase& one) { return one.setting.starts_with(hard::kBulletSetting); }

// Only exact promises what is asked of a break; the others are there to be compared.
bool isPromised(const HardCase& one) { return one.setting != "double" && one.setting != "fast" && !isBullet(one); }

void printBulletSum(const std::vector<HardCase>& rows) {
    const auto passing = std::ranges::count_if(rows, [](const HardCase& c) { return c.has_passed; });
    std::printf("Bullet: %zu cases by the same checks: %td pass\n", rows.size(), passing);
}

void printOurSum(const std::vector<HardCase>& outcomes) {
    const auto count = [&](auto&& is) { return std::ranges::count_if(outcomes, is); };
    std::printf(
        "\n%zu cases: %td pass, %td of them short of what is known to be out of reach; %td fail at a precision that promises "
        "nothing, %td else\n",
        outcomes.size(), count([](const HardCase& c) { return c.has_passed; }),
        count([](const HardCase& c) { return c.has_passed && c.is_known_shortfall; }),
        count([](const HardCase& c) { return !c.has_passed && !isPromised(c); }),
        count([](const HardCase& c) { return !c.has_passed && isPromised(c); }));
}

void printSum(const std::vector<HardCase>& outcomes) {
    std::vector<HardCase> ours, bullets;
    std::ranges::partition_copy(outcomes, std::back_inserter(bullets), std::back_inserter(ours), isBullet);
    printOurSum(ours);
    if (!bullets.empty()) printBulletSum(bullets);
}

// Goes by how long the cases took so far, which are not alike: no more than a hint.
hard::RunWatch watchOnTerminal() {
    const auto begun = std::chrono::steady_clock::now();
    const auto begins = [begun](const hard::RunStep& step) {
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
        const double left =
            step.number == 0 ? 0 : seconds / static_cast<double>(step.number) * static_cast<double>(step.count - step.number);
        if (step.number == 0) printHead();
        char text[192];
        std::snprintf(text, sizeof text, "%zu of %zu: %s, %s; about %.0f s left", step.number + 1, step.count,
                      step.name.c_str(), step.setting.c_str(), left);
        showProgress(text);
    };
    const auto ended = [](const HardCase& one) {
        clearProgress();
        printRow(one);
    };
    const auto left_out = [](const HardCase& one) {
        clearProgress();
        std::printf("%-46s %-13s left out: %s\n", one.name.c_str(), one.setting.c_str(), one.why.c_str());
    };
    return {begins, ended, left_out};
}

// What `brittle accuracy` has left in the folder, to which the matrix is added; else there is nothing but the matrix.
Result<Results> resultsWith(const fs::path& folder, const engine::Device& device, std::vector<HardCase> outcomes) {
    Results results;
    results.machine = accuracy::describeMachine(device);
    if (fs::exists(folder / "results.json")) {
        auto there = accuracy::readResults(folder / "results.json");
        if (!there) return there.error();
        results = std::move(*there);
    }
    results.hard = std::move(outcomes);
    return results;
}

// Before anything is measured, since that takes minutes. What `brittle accuracy` has left has to be such results.
Result<void> prepare(const fs::path& folder, accuracy::ResultFiles& files) {
    if (fs::exists(folder / "results.json"))
        if (const auto there = accuracy::readResults(folder / "results.json"); !there) return there.error();
    return files.open(folder, {accuracy::kResultsFile, accuracy::kPageFile});
}

Result<void> listCases(const std::string& only) {
    const auto names = hard::hardCaseNames(only);
    if (!names) return names.error();
    for (const std::string& name : *names)
        std::printf("%s\n", name.c_str());
    return {};
}

int runHard(const HardOptions& options) {
    if (options.list) {
        const auto listed = listCases(options.run.only);
        return listed ? kOk : fail(listed.error());
    }
    const auto device = engine::Device::create({.select = options.device});
    if (!device) return fail(device.error());
    accuracy::ResultFiles files;
    if (!options.folder.empty())
        if (auto ready = prepare(options.folder, files); !ready) return fail(ready.error());
    auto outcomes = hard::runHardCases(**device, options.run, watchOnTerminal());
    if (!outcomes) return fail(outcomes.error());
    printSum(*outcomes);
    const bool all_hold = std::ranges::all_of(*outcomes, [](const HardCase& c) { return c.has_passed || !isPromised(c); });
    if (!options.folder.empty()) {
        auto results = resultsWith(options.folder, **device, std::move(*outcomes));
        if (!results) return fail(results.error());
        if (auto written = files.write(*results); !written) return fail(written.error());
        std::printf("report     %s\n", (fs::path(options.folder) / "report.html").c_str());
    }
    return all_hold ? kOk : kInternalError;
}

constexpr const char* kHardFooter =
    "Examples:\n"
    "  brittle hard\n"
    "  brittle hard --only plate\n"
    "  brittle hard -o out/accuracy\n"
    "  brittle hard --only hard_38 --bullet\n"
    "  brittle hard --scale 0.01 --long\n"
    "\n"
    "Sites in ties and crowds, models that are thin, tiny, huge, far away or of slivers, fragments of fragments, meshes that "
    "bound no\n"
    "solid, full pools, and scenes that break rigid-body engines. Each has to fulfill what stands in the row: the worst of all "
    "that\n"
    "was measured, next to what is allowed. Breaks are made at every precision; only exact promises anything. `short` is what "
    "is\n"
    "known to be out of reach. With -o the matrix goes into results.json and onto the page of that folder, next to what\n"
    "`brittle accuracy` has measured there. With --bullet a case of motion has a second row: Bullet moves the\n"
    "same scene and is judged by the same checks. It says which cases are left out since their checks ask for\n"
    "more. With --scale a case of motion is moved at S times its size, under the same gravity, in steps that are\n"
    "longer by the root of S. Checks read the motion scaled back. Other cases are left out, and the command says why.\n"
    "The exit code is 0 where all that is promised holds; Bullet's rows promise nothing.";

} // namespace

void addHard(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("hard", "Run every hard case at every precision, and show what holds.");
    command->footer(kHardFooter);
    auto options = std::make_shared<HardOptions>();
    command->add_option("--only", options->run.only, "the cases whose name has this in it")
        ->option_text("TEXT")
        ->check(someText);
    command->add_flag("--long", options->run.is_long, "also those that take minutes each");
    command->add_flag("--bullet", options->run.with_bullet, "also Bullet, by the same checks; where the build has it");
    CLI::Option* scale =
        command->add_option("--scale", options->run.scale, "only cases of motion, at S times their size; S: 0.001 to 1000");
    inRange(scale, hard::kSmallestScale, hard::kLargestScale)->option_text("S");
    command->add_flag("--list", options->list, "run nothing: print the names of all cases, or of those that --only leaves");
    command->add_option("-o,--output", options->folder, "a folder for results.json and report.html")
        ->option_text("DIR")
        ->check(someText);
    command->add_option("--device", options->device, "the Vulkan device, by number or a part of its name; see brittle devices");
    command->callback([options, &exit_code] { exit_code = runHard(*options); });
}

} // namespace cli
