// brittle bench: its options and what it prints.
#include "shaders-spirv/shared/fracture.h"
#include "tools/bench/bench.h"
#include "tools/bench/dynamics_report.h"
#include "tools/brittle/command.h"
#include "tools/brittle/interrupt.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>
#include <optional>
#include <thread>

namespace cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
    bench::BenchOptions bench;
    std::string device, output;
    bool cells_only = false, shatter_only = false, variants_only = false, colliders_only = false, dynamics_only = false;
    bool breaking_only = false, piles_only = false, no_peers = false, plain = false;
    std::vector<uint32_t> breaking_case; // one, in place of all
};

// Below 1: ours is faster.
void addPeer(Json& row, const std::string& peer, double ms, double ours) {
    if (ms == 0) return;
    row[peer + "_ms"] = ms;
    row["times_" + peer] = ours / ms;
}

Json toJson(const bench::CellsRow& cells) {
    Json row = {
        {"sites", cells.sites}, {"ms", cells.ms}, {"us_per_cell", 1000 * cells.ms / cells.sites}, {"link_ms", cells.link_ms}};
    addPeer(row, "voropp", cells.voropp_ms, cells.ms);
    if (!cells.kernels.empty()) row["kernels"] = sharesOf("kernel", cells.kernels);
    return row;
}

Json toJson(const bench::ShatterRow& shatter) {
    Json row = {{"sites", shatter.sites}, {"triangles", shatter.triangles}, {"fragments", shatter.fragments},
                {"ms", shatter.ms},       {"device_ms", shatter.device_ms}, {"stages", sharesOf("stage", shatter.stages)}};
    addPeer(row, "cgal", shatter.cgal_ms, shatter.ms);
    if (!shatter.kernels.empty()) row["kernels"] = sharesOf("kernel", shatter.kernels);
    return row;
}

Json toJson(const bench::CapsRow& caps) {
    return {{"sites", caps.sites},
            {"triangles", caps.triangles},
            {"exact_ms", caps.exact_ms},
            {"convex_ms", caps.convex_ms},
            {"exact_cap_faces_ms", caps.exact_caps_ms},
            {"convex_cap_faces_ms", caps.convex_caps_ms}};
}

Json toJson(const bench::VariantRow& row) {
    return {{"variant", row.name},
            {"what", row.only_cells ? "cells" : "shatter"},
            {"sites", row.sites},
            {"ms", row.ms},
            {"times_default", row.default_ms > 0 ? row.ms / row.default_ms : 0}};
}

Json toJson(const bench::ColliderRow& row) {
    Json json = {{"sites", row.sites},
                 {"directions", row.directions},
                 {"pieces", row.pieces},
                 {"planes", row.planes},
                 {"volume_excess", row.volume_excess},
                 {"ms", row.ms},
                 {"us_per_piece", 1000 * row.ms / static_cast<double>(row.pieces)},
                 {"shatter_ms", row.shatter_ms}};
    if (!row.kernels.empty()) json["kernels"] = sharesOf("kernel", row.kernels);
    return json;
}

template <class Row>
Json toJson(const std::vector<Row>& rows) {
    Json list = Json::array();
    for (const Row& row : rows)
        list.push_back(toJson(row));
    return list;
}

engine::Result<Json> measureDynamics(engine::Device& device, const bench::BenchOptions& options,
                                     const bench::Progress& progress) {
    const auto piles = bench::benchPiles(device, options, progress);
    if (!piles) return piles.error();
    const auto broad_phase = bench::benchBroadPhase(device, options, progress);
    if (!broad_phase) return broad_phase.error();
    const auto narrow_phase = bench::benchNarrowPhase(device, options, progress);
    if (!narrow_phase) return narrow_phase.error();
    return Json{{"piles", pilesReport(*piles)},
                {"broad_phase", broadPhaseReport(*broad_phase)},
                {"narrow_phase", narrowPhaseReport(*narrow_phase)}};
}

engine::Result<Json> measure(engine::Device& device, const bench::BenchOptions& options) {
    const auto progress = [](const std::string& step) { std::fprintf(stderr, "%s\n", step.c_str()); };
    const auto cells = bench::benchCells(device, options, progress);
    if (!cells) return cells.error();
    const auto shatters = bench::benchShatter(device, options, progress);
    if (!shatters) return shatters.error();
    const auto caps = bench::benchCaps(device, options, progress);
    if (!caps) return caps.error();
    const auto growth = bench::benchGrowth(device, options, progress);
    if (!growth) return growth.error();
    const auto variants = bench::benchVariants(device, options, progress);
    if (!variants) return variants.error();
    const auto colliders = bench::benchColliders(device, options, progress);
    if (!colliders) return colliders.error();
    const auto dynamics = measureDynamics(device, options, progress);
    if (!dynamics) return dynamics.error();
    const auto breaking = bench::benchBreaking(device, options, progress);
    if (!breaking) return breaking.error();
    const auto effects = bench::benchBreakingEffects(device, options, progress);
    if (!effects) return effects.error();
    Json report = {{"device", device.name()},
                   {"driver", device.driver()},
                   {"group_size", options.group_size == 0 ? GROUP_SIZE : options.group_size},
                   {"cores", std::thread::hardware_concurrency()},
                   {"rounds", options.rounds},
                   {"cells", toJson(*cells)},
                   {"shatter", toJson(*shatters)},
                   {"caps", toJson(*caps)},
                   {"growth", toJson(*growth)},
                   {"variants", toJson(*variants)},
                   {"colliders", toJson(*colliders)}};
    report.update(*dynamics);
    report["breaking"] = breakingReport(*breaking);
    report["breaking_effects"] = breakingReport(*effects);
    if (options.startup_rounds == 0) return report;
    const auto startup = bench::benchStartup(device, options, progress);
    if (!startup) return startup.error();
    report["startup"] = {{"cold_ms", startup->cold_ms}, {"warm_ms", startup->warm_ms}};
    return report;
}

int write(const Json& report, std::optional<brittle::OutputFile>& file) {
    const std::string text = report.dump(2) + "\n";
    if (!file) return std::fputs(text.c_str(), stdout) < 0 ? kBadInput : kOk;
    if (auto written = file->write(text); !written) return fail(written.error());
    if (auto committed = file->commit(); !committed) return fail(committed.error());
    return kOk;
}

// Before anything is measured, since that takes minutes.
engine::Result<std::optional<brittle::OutputFile>> openOutput(const std::string& path) {
    if (path.empty()) return std::optional<brittle::OutputFile>();
    auto file = cli::createOutput(path);
    if (!file) return file.error();
    return std::optional<brittle::OutputFile>(std::move(*file));
}

engine::Result<void> checkBreakingCase(const std::vector<uint32_t>& numbers) {
    if (numbers.empty() || (numbers[0] >= 1 && numbers[0] <= 256 && numbers[1] >= 2)) return {};
    return engine::Error{engine::ErrorCode::BadInput,
                         "--breaking-case: give 1 to 256 bodies, at least 2 cells of each, and any number that lie about"};
}

// Leaves out what was not asked for, where some parts were.
void keepAskedFor(Options& options) {
    bench::BenchOptions& bench = options.bench;
    bench.only_colliders = options.colliders_only;
    bench.peers = !options.no_peers;
    bench.effects = !options.plain;
    if (!options.breaking_case.empty())
        bench.breaking_cases = {{options.breaking_case[0], options.breaking_case[1], options.breaking_case[2]}};
    if (!options.cells_only && !options.shatter_only && !options.variants_only && !options.colliders_only &&
        !options.dynamics_only && !options.breaking_only && !options.piles_only)
        return;
    if (!options.breaking_only) bench.breaking_cases.clear();
    if (!options.cells_only) bench.cell_counts.clear();
    if (!options.shatter_only && !options.colliders_only) bench.shatter_counts.clear();
    if (!options.colliders_only) bench.collider_directions.clear();
    if (!options.variants_only) {
        bench.variant_cell_counts.clear();
        bench.variant_shatter_counts.clear();
    }
    if (!options.dynamics_only && !options.piles_only) bench.pile_counts.clear();
    if (!options.dynamics_only) {
        bench.box_counts.clear();
        bench.pair_counts.clear();
    }
    bench.growth_levels.clear();
    bench.startup_rounds = 0;
}

int runBench(Options options) {
    if (auto sound = checkBreakingCase(options.breaking_case); !sound) return fail(sound.error());
    keepAskedFor(options);
    auto file = openOutput(options.output);
    if (!file) return fail(file.error());
    auto device = engine::Device::create({.select = options.device});
    if (!device) return fail(device.error());
    const auto report = measure(**device, options.bench);
    return report ? write(*report, *file) : fail(report.error());
}

constexpr const char* kBenchFooter = "Voro++, CGAL and Bullet run alternately with us, on one thread, where the build has them\n"
                                "(tools/bench.sh builds all). Times are medians, in milliseconds; of piles, which run\n"
                                "once, they are means over all steps.";

// Rigid bodies: what falls, what meets, what touches.
void addDynamicsOptions(CLI::App& command, Options& options) {
    command.add_flag("--dynamics", options.dynamics_only, "only rigid bodies: piles, the broad and the narrow phase");
    command.add_flag("--piles", options.piles_only, "only piles");
    command.add_option("--pile-counts", options.bench.pile_counts, "numbers of hulls that fall into a pit; 5000 take minutes")
        ->capture_default_str()
        ->check(CLI::Range(1u, 100'000u));
    command.add_option("--pile-steps", options.bench.pile_steps, "steps of a sixtieth of a second that they are given")
        ->capture_default_str()
        ->check(CLI::Range(1u, 1u << 20));
    command.add_option("--box-counts", options.bench.box_counts, "numbers of boxes, for the broad phase")
        ->capture_default_str()
        ->check(CLI::Range(1u, 1u << 18));
    command.add_option("--pair-counts", options.bench.pair_counts, "numbers of pairs of hulls, for the narrow phase")
        ->capture_default_str()
        ->check(CLI::Range(1u, 500'000u));
}

void addBreakingOptions(CLI::App& command, Options& options) {
    command.add_flag("--plain", options.plain, "leave out what each set of effects costs where bodies break");
    command.add_flag("--breaking", options.breaking_only,
                     "only frames in which bodies break, and what each effect costs there");
    command
        .add_option("--breaking-case", options.breaking_case,
                    "one case in place of all: bodies that break at once, cells of each, bodies that lie about")
        ->expected(3)
        ->check(CLI::Range(0u, 4096u));
}

} // namespace

void addBench(CLI::App& app, int& exit_code) {
    CLI::App* command =
        app.add_subcommand("bench", "Measure cells, whole shatters and rigid bodies, next to Voro++, CGAL and Bullet.");
    command->footer(kBenchFooter);
    auto options = std::make_shared<Options>();
    command->add_option("-o,--output", options->output, "the JSON file to write, instead of standard output");
    command->add_option("--rounds", options->bench.rounds, "how often each is measured")
        ->capture_default_str()
        ->check(CLI::Range(1u, 1000u));
    command->add_option("--cell-counts", options->bench.cell_counts, "numbers of sites in a cube")
        ->capture_default_str()
        ->check(CLI::Range(1u, 1u << 24));
    command->add_option("--shatter-counts", options->bench.shatter_counts, "numbers of sites in the bumpy sphere")
        ->capture_default_str();
    CLI::Option* cells = command->add_flag("--cells", options->cells_only, "only cells");
    CLI::Option* shatters = command->add_flag("--shatter", options->shatter_only, "only whole shatters")->excludes(cells);
    CLI::Option* variants = command
                                ->add_flag("--variants", options->variants_only,
                                           "only searches, mappings of cells and precisions, against the default")
                                ->excludes(cells)
                                ->excludes(shatters);
    command->add_option("--variant-counts", options->bench.variant_cell_counts, "numbers of sites in a cube, for all variants")
        ->capture_default_str()
        ->check(CLI::Range(1u, MOST_LINEAR_SITES));
    CLI::Option* colliders =
        command->add_flag("--colliders", options->colliders_only, "only colliders, of the shatters asked for")
            ->excludes(cells)
            ->excludes(shatters)
            ->excludes(variants);
    addDynamicsOptions(*command, *options);
    addBreakingOptions(*command, *options);
    for (CLI::Option* other : {cells, shatters, variants, colliders}) {
        command->get_option("--dynamics")->excludes(other);
        command->get_option("--breaking")->excludes(other);
    }
    command->get_option("--breaking")->excludes(command->get_option("--dynamics"));
    for (const char* other : {"--cells", "--shatter", "--variants", "--colliders", "--dynamics", "--breaking"})
        command->get_option("--piles")->excludes(command->get_option(other));
    command->add_flag("--no-peers", options->no_peers, "leave out Voro++, CGAL and Bullet");
    command->add_flag("--kernels", options->bench.kernels, "also the time of every kernel, the dearest first");
    addDeviceOptions(*command, options->device, options->bench.group_size);
    command->callback([options, &exit_code] { exit_code = runBench(*options); });
}

} // namespace cli
