// The paper's two figures made anew: time against the number of sites, with the tree and without, even and concentrated
// (figure 14), and the share of each part (figure 15). Its model, an icosphere of 42 vertices.
#include "tools/accuracy/fracture_run.h"

#include <algorithm>
#include <map>
#include <optional>

namespace accuracy {
namespace {

using brittle::FractureOptions;
using brittle::Pattern;
using brittle::Search;
using engine::Result;

const std::vector<uint32_t> kFew = {10, 20, 30, 40, 50, 60, 70, 80, 90, 100};
const std::vector<uint32_t> kMany = {100, 300, 1'000, 3'000, 10'000, 30'000, 100'000};
constexpr double kHitRadius = 0.1; // of the contact, in radii of the ball: nearly all sites lie within three of it
constexpr const char* kGrid = "grid, even sites";

struct SeriesPlan {
    const char* label;
    Search search;
    Pattern pattern;
};
constexpr SeriesPlan kSeries[] = {
    {"all sites in turn (no tree), even sites", Search::Linear, Pattern::Uniform},
    {"sphere tree, even sites", Search::SphereTree, Pattern::Uniform},
    {"all sites in turn (no tree), concentrated", Search::Linear, Pattern::Impact},
    {"sphere tree, concentrated", Search::SphereTree, Pattern::Impact},
    {kGrid, Search::Grid, Pattern::Uniform},
};

class FigureRun {
public:
    FigureRun(Sweep& sweep, const brittle::PreparedMesh& model, brittle::Fracture& fracture)
        : sweep_(sweep), model_(model), fracture_(fracture), rounds_(sweep.options.is_quick ? 3 : 5) {}

    Result<void> draw(const std::vector<uint32_t>& counts, Figure figure, double before, double share) {
        for (const SeriesPlan& plan : kSeries)
            figure.series.push_back({plan.label, {}, ""});
        for (size_t k = 0; k < counts.size(); ++k) {
            const double done = before + share * static_cast<double>(k) / static_cast<double>(counts.size());
            sweep_.progress.show(std::to_string(counts[k]) + " sites", done);
            if (auto measured = addPoints(counts[k], figure); !measured) return measured;
            if (k + 1 < counts.size()) endLongSeries(figure);
        }
        sweep_.results.figures.push_back(std::move(figure));
        return {};
    }

private:
    using Stages = std::map<std::string, std::vector<double>>;

    FractureOptions optionsOf(const SeriesPlan& plan, uint32_t count) const {
        FractureOptions options;
        options.site_count = count;
        options.search = plan.search;
        options.pattern = plan.pattern;
        options.impact = {{0, 0, 1}, kHitRadius, 1};
        return options;
    }

    // All series in turn, again and again.
    Result<void> addPoints(uint32_t count, Figure& figure) {
        std::vector<std::vector<double>> ms(std::size(kSeries));
        Stages stages;
        std::vector<std::string> order;
        for (uint32_t round = 0; round <= rounds_; ++round)
            for (size_t s = 0; s < std::size(kSeries); ++s) {
                if (!figure.series[s].ended.empty() || isLong(ms[s])) continue;
                const auto result = fracture_.shatter(model_.mesh, model_.topology, optionsOf(kSeries[s], count));
                if (!result) figure.series[s].ended = result.error().message;
                if (!result || (round == 0 && !isLong({result->total_ms}))) continue; // the first warms up
                ms[s].push_back(result->total_ms);
                if (kSeries[s].label == kGrid) keepStages(result->timings, stages, order);
            }
        for (size_t s = 0; s < std::size(kSeries); ++s)
            if (!ms[s].empty()) addPoint(count, ms[s], figure.series[s]);
        if (!stages.empty()) addShares(count, stages, order);
        return {};
    }

    // Then once is enough.
    bool isLong(const std::vector<double>& ms) const {
        const double longest = sweep_.isLate() ? 100 : sweep_.options.is_quick ? 500 : 12'000;
        return !ms.empty() && ms.back() > longest;
    }

    static void keepStages(const std::vector<engine::Timing>& timings, Stages& stages, std::vector<std::string>& order) {
        order.clear();
        for (const engine::Timing& timing : timings) {
            stages[timing.name].push_back(timing.ms);
            order.push_back(timing.name);
        }
    }

    static void addPoint(uint32_t count, const std::vector<double>& ms, FigureSeries& series) {
        series.points.push_back({static_cast<double>(count), samplesOf(ms)});
    }

    // Three times as many sites take up to nine times as long.
    void endLongSeries(Figure& figure) const {
        for (FigureSeries& series : figure.series)
            if (series.ended.empty() && !series.points.empty() && isLong({series.points.back().ms.median}))
                series.ended = "more would take too long here" + std::string(sweep_.options.is_quick ? ", at --quick" : "");
    }

    void addShares(uint32_t count, const Stages& stages, const std::vector<std::string>& order) {
        const auto known = [&](const Shares& shares) { return shares.sites == count; };
        if (std::ranges::any_of(sweep_.results.shares, known)) return;
        Shares shares{static_cast<double>(count), {}};
        for (const std::string& stage : order)
            shares.stages.push_back({stage, samplesOf(stages.at(stage)).median});
        sweep_.results.shares.push_back(std::move(shares));
    }

    Sweep& sweep_;
    const brittle::PreparedMesh& model_;
    brittle::Fracture& fracture_;
    uint32_t rounds_;
};

} // namespace

Result<void> measureFigures(Sweep& sweep) {
    const auto model = soundModel("builtin:icosphere:1");
    if (!model) return model.error();
    const auto fracture = brittle::Fracture::create(sweep.device, sweep.options.group_size);
    if (!fracture) return fracture.error();
    FigureRun run(sweep, *model, **fracture);
    const std::string what = "A whole break of an icosphere of 42 vertices, on the device. Concentrated: hit at a point of the "
                             "surface, by the pattern impact, most sites within three tenths of the radius.";
    if (auto few = run.draw(kFew, {"few_sites", "Time against the number of sites, few", what, false, {}}, 0, .3); !few)
        return few;
    return run.draw(kMany, {"many_sites", "Time against the number of sites, many", what, true, {}}, .3, .7);
}

} // namespace accuracy
