// Fracture: precision, caps, search and mapping of cells, on models in which nothing ties and one in which everything does.
#include "tools/accuracy/fracture_run.h"
#include "tools/accuracy/fracture_truth.h"

namespace accuracy {
namespace {

using engine::Result;

constexpr const char* kTime = "a break, on the device from submission to completion";
constexpr const char* kBytes = "on the device, kept from one break to the next";
constexpr uint32_t kSites = 100;

struct FractureWorkload {
    const char *name, *model, *what;
    uint32_t sites, quick_sites;
    const ErrorKind* first; // by which settings are compared
    double share;           // of the time
};

constexpr uint32_t kLatticeSide = 5;
constexpr const char* kLattice = "cube_lattice_125";

const FractureWorkload kFractureWorkloads[] = {
    {"bumpy_20480", "builtin:bumpy:5", "A ball with bumps and hollows, 20480 triangles, in 100 cells", 100, 100,
     &kinds::kTurned, .35},
    {"icosphere_42", "builtin:icosphere:1", "The paper's model, a ball of 42 vertices, in 100 cells", 100, 100,
     &kinds::kCorners, .15},
    {kLattice, "builtin:cube", "A cube in 125 cells about the points of a lattice: every corner of a cell is a tie", 125, 125,
     &kinds::kPromises, .15},
    {"cube_cells", "builtin:cube", "A cube in many even cells, for what is rare", 10000, 1000, &kinds::kPromises, .35},
};

std::vector<brittle::Double3> latticeSites() {
    std::vector<brittle::Double3> sites;
    const auto at = [](uint32_t k) { return (k + 0.5) / kLatticeSide - 0.5; };
    for (uint32_t k = 0; k < kLatticeSide * kLatticeSide * kLatticeSide; ++k)
        sites.push_back({at(k % kLatticeSide), at(k / kLatticeSide % kLatticeSide), at(k / kLatticeSide / kLatticeSide)});
    return sites;
}

void addKinds(Results& results) {
    for (const ErrorKind* kind : {&kinds::kPromises, &kinds::kVolume, &kinds::kArea, &kinds::kCellVolume, &kinds::kCorners,
                                  &kinds::kNeighbors, &kinds::kTurned})
        addKind(results, *kind);
}

// The kinds that there are, the first of them in front.
std::vector<std::string> kindsOf(const std::vector<MeasuredError>& errors, const std::string& first) {
    std::vector<std::string> names = {first};
    for (const MeasuredError& error : errors)
        if (error.kind != first) names.push_back(error.kind);
    return names;
}

Result<void> measureOne(Sweep& sweep, FractureCase what, const std::string& first) {
    FractureTruth truth;
    FractureMeasures measures;
    const size_t index = sweep.results.workloads.size();
    measures.prepare = [&](const brittle::FractureResult& result) { truth = truthOf(what.model.mesh, result.sites); };
    measures.errors = [&](const brittle::FractureResult& result, const brittle::FractureOptions&) {
        std::vector<MeasuredError> errors = errorsOf(truth, result);
        auto& known = sweep.results.workloads[index].kinds;
        if (known.empty()) known = kindsOf(errors, first);
        return errors;
    };
    return measureCase(sweep, what, measures);
}

FractureCase caseOf(const FractureWorkload& workload, brittle::PreparedMesh model, const Options& options) {
    FractureCase one;
    one.workload = {workload.name, "fracture", workload.what, kTime, kBytes, {}};
    one.model = std::move(model);
    one.base.site_count = options.is_quick ? workload.quick_sites : workload.sites;
    if (workload.name == kLattice) one.base.given_sites = latticeSites();
    one.settings = fractureSettings();
    return one;
}

} // namespace

Result<void> sweepFracture(Sweep& sweep) {
    addKinds(sweep.results);
    const double share = 1.0 / (1.0 + 0.2 * static_cast<double>(sweep.options.models.size()));
    double before = 0;
    for (const FractureWorkload& workload : kFractureWorkloads) {
        auto model = soundModel(workload.model);
        if (!model) return model.error();
        FractureCase one = caseOf(workload, std::move(*model), sweep.options);
        one.before = before;
        one.share = share * workload.share;
        before += one.share;
        if (auto done = measureOne(sweep, std::move(one), workload.first->name); !done) return done;
    }
    for (const std::string& name : sweep.options.models) {
        auto model = soundModel(name);
        if (!model) return model.error();
        FractureCase one;
        one.workload = {name,
                        "fracture",
                        "Given: " + std::to_string(model->mesh.triangles.size()) + " triangles, in " + std::to_string(kSites) +
                            " cells",
                        kTime,
                        kBytes,
                        {}};
        one.model = std::move(*model);
        one.base.site_count = kSites;
        one.settings = fractureSettings();
        one.before = before;
        one.share = share * 0.2;
        before += one.share;
        if (auto done = measureOne(sweep, std::move(one), kinds::kTurned.name); !done) return done;
    }
    return {};
}

} // namespace accuracy
