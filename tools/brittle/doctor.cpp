// brittle doctor: whether a model can be broken, what is wrong with it where it cannot, and a mended one where that is
// possible.
#include "modules/brittle/export/model_file.h"
#include "tools/brittle/command.h"
#include "tools/brittle/doctor_report.h"
#include "tools/brittle/interrupt.h"
#include "tools/brittle/model.h"
#include "tools/brittle/progress.h"
#include "tools/brittle/scene_files.h"

#include <filesystem>
#include <optional>

namespace cli {
namespace {

struct DoctorOptions {
    std::string model, output;
    bool repair = false;
    bool as_json = false;
};

engine::Result<std::optional<brittle::OutputFile>> openOutput(const DoctorOptions& options) {
    if (options.output.empty()) return std::optional<brittle::OutputFile>();
    const auto refuse = [&](const std::string& why) {
        return engine::Error{engine::ErrorCode::BadInput, options.output + ": " + why};
    };
    if (!options.repair) return refuse("only a mended model is written; add --repair");
    if (auto apart = checkIsNoInput(options.output, filesOfModel(options.model)); !apart) return apart.error();
    // An ending that cannot be written is better known before the work.
    if (const auto known = brittle::encodeModel({}, std::filesystem::path(options.output).extension().string()); !known)
        return refuse(known.error().message);
    auto file = createOutput(options.output);
    if (!file) return file.error();
    return std::optional<brittle::OutputFile>(std::move(*file));
}

// Examines the model first.
brittle::MeshReport print(const DoctorOptions& options, const brittle::PreparedMesh& model,
                          const std::vector<std::string>& reader_notes, const brittle::RepairNotes* mended) {
    showProgress("examining " + options.model);
    const DoctorReport report{options.model, &model, brittle::diagnoseMesh(model.mesh, model.topology), mended, reader_notes};
    clearProgress();
    if (options.as_json)
        printReportJson(report);
    else
        printReport(report);
    return report.diagnosis.report;
}

engine::Result<void> write(const DoctorOptions& options, const brittle::Mesh& mesh, brittle::OutputFile& file) {
    const auto bytes = brittle::encodeModel(mesh, std::filesystem::path(options.output).extension().string());
    if (!bytes) return bytes.error();
    if (auto written = file.write(*bytes); !written) return written.error();
    if (auto printed = checkPrinted(); !printed) return printed;
    return file.commit();
}

engine::Result<void> examine(const DoctorOptions& options, const brittle::ImportedMesh& imported) {
    const auto named = [&](const std::string& message) {
        return engine::Error{engine::ErrorCode::BadInput, options.model + ": " + message};
    };
    const auto model = brittle::prepareMesh(imported);
    if (!model) {
        reportReaderNotes(options.model, imported.notes);
        return named(model.error().message);
    }
    const brittle::MeshReport report = print(options, *model, imported.notes, nullptr);
    if (report.isSound()) return {};
    return named(report.problems.front() + adviceToRepair(report));
}

engine::Result<void> mend(const DoctorOptions& options, const brittle::ImportedMesh& imported,
                          std::optional<brittle::OutputFile>& output) {
    const auto repaired = brittle::repairMesh(imported);
    if (!repaired) {
        if (const auto model = brittle::prepareMesh(imported)) print(options, *model, imported.notes, nullptr);
        return engine::Error{repaired.error().code, options.model + ": " + repaired.error().message};
    }
    print(options, repaired->model, imported.notes, &repaired->notes);
    reportMended(options.model, repaired->notes);
    return output ? write(options, repaired->model.mesh, *output) : engine::Result<void>();
}

int runDoctor(const DoctorOptions& options) {
    auto output = openOutput(options);
    if (!output) return fail(output.error());
    showProgress("reading " + options.model);
    const auto imported = importModel(options.model);
    if (!imported) return fail(imported.error());
    const auto done = options.repair ? mend(options, *imported, *output) : examine(options, *imported);
    return done ? kOk : fail(done.error());
}

} // namespace

void addDoctor(CLI::App& app, int& exit_code) {
    CLI::App* command =
        app.add_subcommand("doctor", "Say whether a model can be broken, what is wrong where it cannot, and mend it.");
    command->footer("Examples:\n  brittle doctor vase.obj\n  brittle doctor scan.ply --repair -o mended.obj");
    auto options = std::make_shared<DoctorOptions>();
    command->add_option("MODEL", options->model, kModelHelp)->required();
    command->add_flag("--repair", options->repair, kRepairHelp);
    command->add_option("-o,--output", options->output, "write the mended model to this OBJ, OFF or PLY file");
    command->add_flag("--json", options->as_json, "print JSON, with every place");
    command->callback([options, &exit_code] { exit_code = runDoctor(*options); });
}

} // namespace cli
