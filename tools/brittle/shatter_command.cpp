// brittle shatter: its options and what it prints.
#include "modules/brittle/mesh/format.h"
#include "tools/brittle/collider_report.h"
#include "tools/brittle/command.h"
#include "tools/brittle/model.h"
#include "tools/brittle/shatter.h"

#include <nlohmann/json.hpp>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

namespace cli {
namespace {

using brittle::formatCount;
using brittle::formatNumber;

nlohmann::ordered_json toJson(const ShatterOutcome& outcome) {
    const brittle::FractureCounts& counts = outcome.result.counts;
    nlohmann::ordered_json ms = {{"total", outcome.total_ms}};
    for (const auto& [name, value] : outcome.ms)
        ms[name] = value;
    nlohmann::ordered_json json = {
        {"device", outcome.device},
        {"model",
         {{"vertices", outcome.model.vertices},
          {"triangles", outcome.model.triangles},
          {"components", outcome.model.components},
          {"volume", outcome.model.measures.volume},
          {"area", outcome.model.measures.area}}},
        {"sites", {{"requested", counts.sites_requested}, {"used", counts.sites_used}, {"welded", counts.sites_welded}}},
        {"cells",
         {{"ok", counts.cells_ok},
          {"empty", counts.cells_empty},
          {"merged", counts.cells_merged},
          {"dissolved", counts.pieces_dissolved},
          {"refused", counts.cells_refused}}},
        {"fragments", outcome.result.fragments.fragments.size()},
        {"volume_error", outcome.contract.volume_error},
        {"area_error", outcome.contract.area_error},
        {"open_edges", outcome.contract.open_edges},
        {"unpaired_inner_triangles", outcome.contract.unpaired_inner_triangles},
        {"exact_cells", {{"total", counts.exact_total}, {"redone", counts.exact_redone}}},
        {"ms", ms},
    };
    if (!outcome.result.fragments.colliders.pieces.empty()) json["colliders"] = collidersJson(outcome.result.fragments);
    if (outcome.picked) json["picked"] = autoJson(*outcome.picked);
    if (outcome.motion) json["motion"] = simulationJson(*outcome.motion);
    if (!outcome.mended.isEmpty()) json["mended"] = mendedJson(outcome.mended);
    return json;
}

void printText(const ShatterOptions& options, const ShatterOutcome& outcome) {
    const brittle::FractureCounts& counts = outcome.result.counts;
    std::printf("device     %s\n", outcome.device.c_str());
    std::printf("model      %s: %s, %s, volume %s\n", options.model.c_str(),
                formatCount(outcome.model.triangles, "triangle").c_str(), formatCount(outcome.model.components, "part").c_str(),
                formatNumber(outcome.model.measures.volume).c_str());
    std::printf("sites      %u asked for, %u used, %u welded\n", counts.sites_requested, counts.sites_used,
                counts.sites_welded);
    std::printf("cells      %u ok, %u empty, %u merged, %u refused; %u of %u done again exactly\n", counts.cells_ok,
                counts.cells_empty, counts.cells_merged, counts.cells_refused, counts.exact_redone, counts.exact_total);
    if (outcome.picked) printAuto(*outcome.picked);
    std::printf("fragments  %zu, in %s\n", outcome.result.fragments.fragments.size(), options.output.c_str());
    if (!outcome.result.fragments.colliders.pieces.empty()) printColliders(outcome.result.fragments);
    for (const std::string& picture : {options.picture, options.collider_picture})
        if (!picture.empty()) std::printf("picture    %s\n", picture.c_str());
    if (options.verify)
        std::printf("verified   volume error %.2g, area error %.2g, every fragment closed, connected and within its cell\n",
                    outcome.contract.volume_error, outcome.contract.area_error);
    std::printf("time       %.1f ms in all\n", outcome.total_ms);
    for (const auto& [name, ms] : outcome.ms)
        std::printf("  %-22s %9.2f ms\n", name.c_str(), ms);
    if (outcome.motion) printSimulation(*outcome.motion, options.output);
}

engine::Result<void> print(const ShatterOptions& options, const ShatterOutcome& outcome) {
    reportMended(options.model, outcome.mended);
    if (options.as_json)
        std::printf("%s\n", toJson(outcome).dump(2).c_str());
    else
        printText(options, outcome);
    return checkPrinted();
}

int runShatter(const ShatterOptions& options) {
    const auto done = shatter(options, [&](const ShatterOutcome& outcome) { return print(options, outcome); });
    return done ? kOk : fail(done.error());
}

constexpr const char* kHalfOfModel = "half";
constexpr uint32_t kUsualColliders = 26;
const std::map<std::string, uint32_t> kColliders = {{"none", 0}, {"6", 6}, {"14", 14}, {"26", 26}, {"62", 62}};

constexpr const char* kShatterFooter =
    "Examples:\n"
    "  brittle shatter vase.obj -o pieces.glb --sites 200 --seed 7 --verify\n"
    "  brittle shatter builtin:ring -o ring.glb --picture ring.png --explode 0.3\n"
    "  brittle shatter rock.obj -o pieces.glb --sites-file rock_sites.txt --json\n"
    "  brittle shatter vase.obj -o pieces.glb --sites 80 --at 0,0.1,0.3 --strength 5\n"
    "  brittle shatter vase.obj -o pieces.glb --collider 26 --collider-picture hulls.png --explode 0.3\n"
    "  brittle shatter vase.obj -o fall.glb --sites 60 --drop 0.5\n"
    "\n"
    "A sites file is text with one site a line, x y z in the model's coordinates; # begins a comment.\n"
    "Built-in models: builtin:ring, builtin:cube, builtin:icosphere:LEVEL, builtin:bumpy:LEVEL.";

const std::map<std::string, brittle::Pattern> kPatterns = {{"uniform", brittle::Pattern::Uniform},
                                                           {"impact", brittle::Pattern::Impact},
                                                           {"paper", brittle::Pattern::Paper},
                                                           {"radial", brittle::Pattern::Radial}};
const std::map<std::string, brittle::Search> kSearches = {{"auto", brittle::Search::Auto},
                                                          {"linear", brittle::Search::Linear},
                                                          {"sphere_tree", brittle::Search::SphereTree},
                                                          {"grid", brittle::Search::Grid}};
const std::map<std::string, brittle::CellMapping> kMappings = {
    {"auto", brittle::CellMapping::Auto}, {"lanes", brittle::CellMapping::Lanes}, {"edges", brittle::CellMapping::Edges}};
const std::map<std::string, brittle::Precision> kPrecisions = {
    {"exact", brittle::Precision::Exact}, {"double", brittle::Precision::Double}, {"fast", brittle::Precision::Fast}};

const std::map<std::string, brittle::Caps> kCaps = {{"exact", brittle::Caps::Exact}, {"convex", brittle::Caps::Convex}};

// Takes one of the names; CLI11's own says so in terms of its tables.
template <class Value>
CLI::Validator oneOf(const std::map<std::string, Value>& names) {
    return {[&names](std::string& text) {
                if (const auto found = names.find(text); found != names.end()) {
                    text = std::to_string(static_cast<uint32_t>(found->second));
                    return std::string();
                }
                std::string all;
                for (const auto& [name, ignored] : names)
                    all += (all.empty() ? "" : ", ") + name;
                return "\"" + text + "\" is none of " + all;
            },
            ""};
}

// CLI11 takes -1 for the largest number, and what is too large for it as well.
std::string wholeNumber(const std::string& text) {
    uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size() ? "" : "\"" + text + "\" is no whole number below 2^64";
}

// "X,Y,Z"
std::optional<brittle::Double3> placeOf(const std::string& text) {
    brittle::Double3 place;
    const char* at = text.c_str();
    for (size_t k = 0; k < 3; ++k) {
        char* end = nullptr;
        place[k] = std::strtod(at, &end);
        if (end == at || !std::isfinite(place[k]) || *end != (k < 2 ? ',' : '\0')) return std::nullopt;
        at = end + 1;
    }
    return place;
}

void addPattern(CLI::App& command, const std::shared_ptr<ShatterOptions>& options) {
    CLI::Option* pattern =
        command
            .add_option(
                "--pattern", options->pattern,
                "where sites are placed: uniform, impact, paper or, for panes, radial (in spokes and rings); with --at impact "
                "if not said otherwise")
            ->transform(oneOf(kPatterns))
            ->option_text("NAME [uniform]");
    command
        .add_option_function<std::string>(
            "--at",
            [options, pattern](const std::string& text) {
                options->at = placeOf(text);
                if (pattern->count() == 0) options->pattern = brittle::Pattern::Impact;
            },
            "where the model is hit, X,Y,Z in its coordinates; without it the center of its box")
        ->check([](const std::string& text) { return placeOf(text) ? "" : "\"" + text + "\" is no place X,Y,Z"; });
    command.add_option("--relax", options->relax, "rounds in which each site moves to the middle of its cell: evener pieces")
        ->capture_default_str()
        ->check(CLI::Range(0u, 1000u));
    command
        .add_option(
            "--candidates", options->candidates,
            "a site, of pattern paper: the nearest to the hit is taken, the surer the stronger it is; more crowd closer")
        ->capture_default_str()
        ->check(CLI::Range(1u, uint32_t{PAPER_LANES}));
    inRange(command.add_option("--strength", options->strength, "of the hit, in joules where the model is in meters"), 0, 1e12)
        ->capture_default_str();
}

std::string heightAbove(const std::string& text) {
    const char* end = text.c_str();
    const double height = std::strtod(text.c_str(), const_cast<char**>(&end));
    const bool is_height = !text.empty() && *end == '\0' && height >= 0 && height <= 1e5;
    return is_height ? "" : "\"" + text + "\" is no height from 0 to 100000";
}

void addDrop(CLI::App& command, const std::shared_ptr<ShatterOptions>& options) {
    const auto dropped = [options]() -> DropOptions& { return options->drop ? *options->drop : options->drop.emplace(); };
    CLI::Option* drop =
        command
            .add_option_function<std::string>(
                "--drop",
                [dropped](const std::string& height) {
                    dropped();
                    if (height != kHalfOfModel) dropped().height = std::strtod(height.c_str(), nullptr);
                },
                "let the fragments fall onto the ground, so many meters below the model, and write their motion")
            ->expected(0, 1)
            ->default_str(kHalfOfModel)
            ->check([](const std::string& text) { return text == kHalfOfModel ? "" : heightAbove(text); })
            ->option_text("[HEIGHT] [half of the model's]");
    auto* seconds = command.add_option_function<double>(
        "--seconds", [dropped](double s) { dropped().seconds = s; }, "with --drop: how long they are simulated");
    inRange(seconds, 0, kMostSeconds)->needs(drop)->option_text("SECONDS [3]");
    auto* fps = command.add_option_function<double>(
        "--fps", [dropped](double f) { dropped().fps = f; }, "with --drop: frames a second");
    inRange(fps, kLeastFps, kMostFps)->needs(drop)->option_text("FPS [60]");
}

// What falls has to meet something.
void chooseColliders(const CLI::Option& collider, ShatterOptions& options) {
    if (!options.drop) return;
    if (collider.count() == 0) options.collider = kUsualColliders;
    if (options.collider == 0)
        throw CLI::ValidationError("--drop",
                                   "needs colliders for the fragments to lie on; ask for --collider 26 or leave it out");
}

} // namespace

void addShatter(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("shatter", "Break a closed model into closed fragments.");
    command->footer(kShatterFooter);
    auto options = std::make_shared<ShatterOptions>();
    command->add_option("MODEL", options->model, kModelHelp)->required();
    command
        ->add_option("-o,--output", options->output,
                     "the GLB file to write, a node for every fragment; with --drop also .png or .mp4")
        ->required()
        ->check(someText);
    CLI::Option* sites = command->add_option("--sites", options->sites, "how many sites, and so about how many fragments")
                             ->capture_default_str();
    sites->check(CLI::Range(1u, 1u << 24));
    command->add_option("--seed", options->seed, "another seed breaks it otherwise")->capture_default_str()->check(wholeNumber);
    command->add_option("--sites-file", options->sites_file, "sites from a text file instead")
        ->excludes(sites)
        ->check(someText);
    addPattern(*command, options);
    command->add_option("--search", options->search, "how cells find their neighbors: auto, linear, sphere_tree or grid")
        ->transform(oneOf(kSearches))
        ->option_text("NAME [auto]");
    command
        ->add_option("--caps", options->caps, "how cut faces are made: exact, or convex, which is faster and for convex models")
        ->transform(oneOf(kCaps))
        ->option_text("NAME [exact]");
    command
        ->add_option(
            "--cells", options->cells,
            "how cells are spread over the device: auto, lanes (a lane a cell) or edges (a lane an edge, as in the paper)")
        ->transform(oneOf(kMappings))
        ->option_text("NAME [auto]");
    command
        ->add_option("--precision", options->precision,
                     "of the decisions: exact, double or fast; what is not exact may fail its check, and then writes nothing")
        ->transform(oneOf(kPrecisions))
        ->option_text("NAME [exact]");
    addAutoOptions(*command, options->wish, "the break", accuracy::kFractureFamily.error);
    for (const char* wish : {"--budget-ms", "--tolerance"}) // they pick these
        for (const char* picked : {"--precision", "--caps", "--search", "--cells"})
            command->get_option(wish)->excludes(command->get_option(picked));
    CLI::Option* collider =
        command
            ->add_option(
                "--collider", options->collider,
                "also make a convex piece to collide with for every fragment, from so many directions: none, 6, 14, 26 or 62")
            ->transform(oneOf(kColliders))
            ->option_text("DIRECTIONS [none]");
    command->add_option("--collider-picture", options->collider_picture, "draw the colliders into this PNG file")
        ->needs(collider)
        ->check(someText);
    addDrop(*command, options);
    command->add_flag("--repair", options->repair, kRepairHelp);
    command->add_flag("--verify", options->verify,
                      "say in words what the check of the fragments found; nothing is written where it fails");
    command->add_option("--picture", options->picture, "also draw them into this PNG file")->check(someText);
    auto* explode = command->add_option("--explode", options->explode,
                                        "in the picture, move fragments this many times further from the center");
    inRange(explode, 0, 1000)->capture_default_str();
    command->add_flag("--json", options->as_json, "print one JSON object, errors measured");
    addDeviceOptions(*command, options->device, options->group_size, "; the fragments are the same");
    command->callback([command, collider, options, &exit_code] {
        chooseColliders(*collider, *options);
        const bool aimed = options->pattern != brittle::Pattern::Uniform;
        for (const char* name : {"--at", "--strength"})
            if (command->get_option(name)->count() > 0 && !aimed)
                throw CLI::ValidationError(name, "says nothing to sites that are placed uniformly; ask for --pattern impact");
        exit_code = runShatter(*options);
    });
}

} // namespace cli
