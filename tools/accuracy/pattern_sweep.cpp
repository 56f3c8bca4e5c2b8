// Patterns of sites in the cube about the origin: how true each is to its own law, and what it costs.
#include "tools/accuracy/fracture_run.h"

#include <algorithm>
#include <cmath>

namespace accuracy {
namespace {

using brittle::Double3;
using brittle::FractureResult;
using brittle::Pattern;
using engine::Result;

const ErrorKind kPlaces = {"places",
                           "places of sites against the law of their pattern, largest difference of the distributions", "share",
                           "closed forms in the cube"};
const ErrorKind kSizes = {"sizes",
                          "volumes of inner cells against those of even sites, largest difference of the distributions",
                          "share", "the gamma law that Ferenc and Neda (2007) found for three dimensions"};

const ErrorKind kCrowdingError = {
    "crowding", "distances of sites from the hit against those of a real one, largest difference of the distributions", "share",
    "the fourth power of the distance, by which the density of a hit's cracks falls outside the contact"};

constexpr double kNoticed = 1.358; // over the root of n: the distance that 95 of 100 samples of the law itself stay below
constexpr double kContactRadius = 0.05, kHalf = 0.5, kInner = 0.35;
constexpr size_t kBins = 24;

using Distribution = double (*)(double); // cumulated

// Of a site in the cube, as a share of the way from the middle to the outside: even sites have its third power, the paper's,
// which are drawn evenly along the way, the share itself.
double shareOfWay(const Double3& p) { return 2 * std::max({std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2])}); }
double evenLaw(double share) { return std::pow(std::clamp(share, 0.0, 1.0), 3); }
double paperLaw(double share) { return std::clamp(share, 0.0, 1.0); }

double impactMass(double r) { return r < kContactRadius ? std::pow(r / kContactRadius, 3) / 3 : 4.0 / 3 - kContactRadius / r; }
double impactLaw(double r) { return impactMass(std::clamp(r, 0.0, kHalf)) / impactMass(kHalf); }

// Of y, volumes over their mean: 3125/24 y^4 e^(-5y), cumulated.
double sizeLaw(double y) {
    double term = 1, sum = 0;
    for (int k = 0; k < 5; ++k) {
        sum += term;
        term *= 5 * y / (k + 1);
    }
    return 1 - std::exp(-5 * y) * sum;
}

double distanceToLaw(std::vector<double> values, Distribution law) {
    std::ranges::sort(values);
    const auto n = static_cast<double>(values.size());
    double most = 0;
    for (size_t k = 0; k < values.size(); ++k) {
        const double expected = law(values[k]), below = static_cast<double>(k) / n;
        most = std::max({most, std::fabs(expected - below), std::fabs(expected - below - 1 / n)});
    }
    return most;
}

struct PatternLaw {
    std::vector<double> values;
    Distribution law;
};

// Those that lie in the largest ball about the hit that the cube holds.
PatternLaw distancesOf(const FractureResult& result) {
    PatternLaw distances = {{}, impactLaw};
    for (const Double3& site : result.sites) {
        const double r = std::hypot(site[0], site[1], site[2]);
        if (r < kHalf) distances.values.push_back(r);
    }
    return distances;
}

PatternLaw placesOf(const FractureResult& result, Pattern pattern) {
    if (pattern == Pattern::Impact) return distancesOf(result);
    PatternLaw places = {{}, pattern == Pattern::Paper ? paperLaw : evenLaw};
    for (const Double3& site : result.sites)
        places.values.push_back(shareOfWay(site));
    return places;
}

// Those of sites far from the cube's faces, which would cut them off.
PatternLaw sizesOf(const FractureResult& result) {
    PatternLaw sizes = {{}, sizeLaw};
    const auto count = static_cast<double>(result.sites.size());
    for (const brittle::Fragment& fragment : result.fragments.fragments)
        if (shareOfWay(fragment.site) < 2 * kInner) sizes.values.push_back(fragment.volume * count);
    return sizes;
}

MeasuredError errorOf(const ErrorKind& kind, const PatternLaw& law) {
    return {kind.name, distanceToLaw(law.values, law.law), kNoticed / std::sqrt(static_cast<double>(law.values.size()))};
}

Law drawnLaw(Law law, const PatternLaw& found, double most) {
    law.count = static_cast<double>(found.values.size());
    law.distance = distanceToLaw(found.values, found.law);
    law.resolution = kNoticed / std::sqrt(law.count);
    for (size_t k = 0; k < kBins; ++k) {
        const double from = most * static_cast<double>(k) / kBins, to = most * static_cast<double>(k + 1) / kBins;
        const auto within = std::ranges::count_if(found.values, [&](double x) { return x >= from && x < to; });
        law.bins.push_back({from, to, static_cast<double>(within) / (law.count * (to - from)),
                            (found.law(to) - found.law(from)) / (to - from)});
    }
    return law;
}

void addLaws(Results& results, Pattern pattern, uint32_t relax, const FractureResult& result) {
    if (relax > 0) return;
    if (pattern == Pattern::Uniform)
        results.laws.push_back(drawnLaw({"Sizes of fragments, pattern uniform",
                                         "volume over the mean volume",
                                         "gamma law of even sites, 3125/24 y^4 e^(-5y)",
                                         "Ferenc and Neda 2007",
                                         0,
                                         0,
                                         0,
                                         {}},
                                        sizesOf(result), 2.6));
    if (pattern == Pattern::Impact)
        results.laws.push_back(drawnLaw({"Distance from the hit, pattern impact",
                                         "distance in edges of the cube",
                                         "even within the contact radius of 0.05, falling with the fourth power outside",
                                         "modules/brittle/fracture/pattern.h",
                                         0,
                                         0,
                                         0,
                                         {}},
                                        placesOf(result, pattern), 0.3));
    if (pattern == Pattern::Paper)
        results.laws.push_back(drawnLaw({"Places of sites, pattern paper",
                                         "share of the way from the middle to the surface",
                                         "even along the way",
                                         "the paper, figure 2",
                                         0,
                                         0,
                                         0,
                                         {}},
                                        placesOf(result, pattern), 1));
}

FractureCase patternCase(brittle::PreparedMesh model, bool is_quick) {
    FractureCase one;
    one.workload = {"cube_patterns",
                    "patterns",
                    "A cube, hit in the middle, for the law that each pattern of sites should follow",
                    "a break, on the device from submission to completion",
                    "on the device, kept from one break to the next",
                    {kPlaces.name, kSizes.name}};
    one.model = std::move(model);
    one.base.site_count = is_quick ? 1000 : 5000;
    one.base.impact.contact_radius = kContactRadius;
    one.settings = patternSettings();
    one.share = 0.5;
    return one;
}

FractureCase crowdingCase(brittle::PreparedMesh model, bool is_quick) {
    FractureCase one = patternCase(std::move(model), is_quick);
    one.workload.name = "cube_hit";
    one.workload.what = "The same cube under a blow so strong that it draws every site to it";
    one.workload.kinds = {kCrowdingError.name};
    one.base.pattern = Pattern::Impact;
    one.base.impact.favor = 1;
    one.settings = crowdingSettings();
    one.before = one.share = 0.5;
    return one;
}

Result<void> sweepPlaces(Sweep& sweep, const FractureCase& one) {
    FractureMeasures measures;
    measures.errors = [&](const FractureResult& result, const brittle::FractureOptions& options) {
        addLaws(sweep.results, options.pattern, options.relax, result);
        std::vector<MeasuredError> errors = {errorOf(kPlaces, placesOf(result, options.pattern))};
        if (options.pattern == Pattern::Uniform) errors.push_back(errorOf(kSizes, sizesOf(result)));
        return errors;
    };
    return measureCase(sweep, one, measures);
}

Result<void> sweepCrowding(Sweep& sweep, const FractureCase& one) {
    FractureMeasures measures;
    measures.errors = [](const FractureResult& result, const brittle::FractureOptions&) {
        return std::vector<MeasuredError>{errorOf(kCrowdingError, distancesOf(result))};
    };
    return measureCase(sweep, one, measures);
}

} // namespace

Result<void> sweepPatterns(Sweep& sweep) {
    for (const ErrorKind& kind : {kPlaces, kSizes, kCrowdingError})
        addKind(sweep.results, kind);
    auto model = soundModel("builtin:cube");
    if (!model) return model.error();
    const bool is_quick = sweep.options.is_quick;
    if (auto done = sweepPlaces(sweep, patternCase(*model, is_quick)); !done) return done;
    return sweepCrowding(sweep, crowdingCase(std::move(*model), is_quick));
}

} // namespace accuracy
