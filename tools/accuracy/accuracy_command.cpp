// brittle accuracy: its options, and the files it writes.
#include "tools/accuracy/fracture_run.h"
#include "tools/accuracy/price_list.h"
#include "tools/accuracy/report.h"
#include "tools/accuracy/result_files.h"
#include "tools/accuracy/sweep.h"
#include "tools/brittle/command.h"
#include "tools/brittle/model.h"
#include "tools/brittle/progress.h"

#include <cstdio>
#include <memory>

namespace cli {
namespace {

using engine::Result;

struct AccuracyOptions {
    accuracy::Options sweep;
    std::string folder = "accuracy", from, device;
};

Result<void> checkModels(const std::vector<std::string>& models) {
    for (const std::string& name : models)
        if (const auto model = accuracy::soundModel(name); !model) return model.error();
    return {};
}

int show(const accuracy::Results& results, accuracy::ResultFiles& files, const std::string& folder) {
    if (auto written = files.write(results); !written) return fail(written.error());
    clearProgress();
    std::printf("%s\nreport     %s\n", usefulTable(results).c_str(), (std::filesystem::path(folder) / "report.html").c_str());
    return kOk;
}

int rewritePage(const AccuracyOptions& options) {
    const auto results = accuracy::readResults(options.from);
    if (!results) return fail(results.error());
    accuracy::ResultFiles files;
    if (auto opened = files.open(options.folder, {accuracy::kPageFile}); !opened) return fail(opened.error());
    return show(*results, files, options.folder);
}

// What `brittle hard` has left in the folder, if it was the same program on the same device.
void keepHardCases(accuracy::Results& results, const std::filesystem::path& folder) {
    auto before = accuracy::readResults(folder / "results.json");
    if (!before || before->machine.commit != results.machine.commit || before->machine.device != results.machine.device) return;
    results.hard = std::move(before->hard);
}

// What may be wrong is looked for before anything is measured, which takes minutes.
int measureAnew(const AccuracyOptions& options) {
    if (auto sound = checkModels(options.sweep.models); !sound) return fail(sound.error());
    const auto device = engine::Device::create({.select = options.device, .share_pipelines = true});
    if (!device) return fail(device.error());
    accuracy::ResultFiles files;
    if (auto opened = files.open(options.folder, {accuracy::kResultsFile, accuracy::kTableFile, accuracy::kPageFile}); !opened)
        return fail(opened.error());
    auto results = accuracy::measureAll(**device, options.sweep);
    if (!results) return fail(results.error());
    keepHardCases(*results, options.folder);
    accuracy::keepPriceList(*results);
    return show(*results, files, options.folder);
}

int runAccuracy(const AccuracyOptions& options) { return options.from.empty() ? measureAnew(options) : rewritePage(options); }

constexpr const char* kAccuracyFooter =
    "Examples:\n"
    "  brittle accuracy --quick -o out/accuracy\n"
    "  brittle accuracy vase.stl rock.obj -o out/accuracy\n"
    "  brittle accuracy --from out/accuracy/results.json -o out/page\n"
    "\n"
    "DIR gets results.json with every measurement, results.csv with a row for each, and report.html, one page that needs no\n"
    "network. Every knob is turned alone, and some two at a time; all settings take turns in every round, so that a machine\n"
    "that is busy for a while is busy for all of them. Times are medians with their quartiles. Errors are against references\n"
    "in double precision and closed forms. On stdout stand the most useful lines of the price list.\n"
    "They are kept as the prices of this device, by which --budget-ms and --tolerance of shatter and simulate pick settings.";

} // namespace

void addAccuracy(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("accuracy", "Measure what accuracy costs in time, and show it on a page.");
    command->footer(kAccuracyFooter);
    auto options = std::make_shared<AccuracyOptions>();
    CLI::Option* models = command->add_option("MODEL", options->sweep.models, std::string("to break besides: ") + kModelHelp);
    CLI::Option* quick = command->add_flag("--quick", options->sweep.is_quick,
                                           "fewer sites, bodies and rounds: minutes, not a quarter of an hour and more");
    command->add_option("-o,--output", options->folder, "the folder to write to; it is made where there is none")
        ->option_text("DIR [accuracy]")
        ->check(someText);
    command->add_option("--from", options->from, "measure nothing: write the page of these results.json")
        ->option_text("FILE")
        ->check(someText)
        ->excludes(models)
        ->excludes(quick);
    addDeviceOptions(*command, options->device, options->sweep.group_size);
    command->callback([options, &exit_code] { exit_code = runAccuracy(*options); });
}

} // namespace cli
