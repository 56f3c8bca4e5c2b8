#include "tools/device_check/check_parts.h"

namespace device_check {
namespace {

constexpr Part kParts[] = {
    {"device", "device facts", 15, checkDevice},
    {"kernels", "kernels against their oracles", 60, checkKernels, true},
    {"programs", "tests of engine, module and C interface", 75, checkPrograms, true},
    {"models", "fragments against the expected bytes", 30, checkModels},
    {"scenes", "scenes, twice each", 35, checkScenes},
    {"motion", "where motion begins to differ", 10, compareMotion},
    {"validation", "kernels under the validation layer", 20, checkValidation},
    {"idle", "steps in which nothing happens", 15, measureIdle},
    {"bench", "times", 65, measureBench},
    {"start", "start of a process, cold and warm", 25, measureStart},
};

} // namespace

std::span<const Part> checkParts() { return kParts; }

} // namespace device_check
