// The rows of rigid bodies as `brittle bench` prints them.
#pragma once

#include "tools/bench/bench.h"

#include <nlohmann/json.hpp>

namespace cli {

// Growth is the power of the number of bodies, boxes or pairs that the time grew with since the row before.
nlohmann::ordered_json pilesReport(const std::vector<bench::PileRow>& rows);
nlohmann::ordered_json broadPhaseReport(const std::vector<bench::BroadPhaseRow>& rows);
nlohmann::ordered_json narrowPhaseReport(const std::vector<bench::NarrowPhaseRow>& rows);
nlohmann::ordered_json breakingReport(const std::vector<bench::BreakingRow>& rows);

// Names with their time and their share in all of them.
nlohmann::ordered_json sharesOf(const char* what, const bench::Times& times);

} // namespace cli
