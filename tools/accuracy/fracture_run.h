// Breaks a model under every setting of a list, a turn each in every round.
#pragma once

#include "modules/brittle/mesh/prepare.h"
#include "tools/accuracy/fracture_settings.h"
#include "tools/accuracy/sweep.h"

namespace accuracy {

struct FractureCase {
    Workload workload;
    brittle::PreparedMesh model;
    brittle::FractureOptions base; // what settings are applied to
    std::span<const FractureSetting> settings;
    double share = 1, before = 0; // of the sweep's part, for its progress
};

// Of a result and what it was asked for by; called once a setting.
using ErrorsOf = std::function<std::vector<MeasuredError>(const brittle::FractureResult&, const brittle::FractureOptions&)>;
// Milliseconds of one run that count.
using TimeOf = std::function<double(const brittle::FractureResult&)>;
// Called with the default's result before errors are asked for.
using Prepare = std::function<void(const brittle::FractureResult&)>;

struct FractureMeasures {
    Prepare prepare;
    ErrorsOf errors;
    TimeOf time = [](const brittle::FractureResult& result) { return result.total_ms; };
};

// A setting that fails, or that the device has not got, is a measurement that says why.
engine::Result<void> measureCase(Sweep& sweep, const FractureCase& what, const FractureMeasures& measures);

// A built-in model (mesh/primitives.h) or a file. Errors: BadInput, also for what does not bound a solid.
engine::Result<brittle::PreparedMesh> soundModel(const std::string& name);

} // namespace accuracy
