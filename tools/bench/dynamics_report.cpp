#include "tools/bench/dynamics_report.h"

#include <cmath>

namespace cli {
namespace {

using Json = nlohmann::ordered_json;

void addGrowth(Json& row, double from_count, double from_ms, double count, double ms) {
    if (from_count > 0 && from_ms > 0 && ms > 0 && count != from_count)
        row["growth"] = std::log(ms / from_ms) / std::log(count / from_count);
}

Json toJson(const bench::PileState& state) {
    return {{"overlaps", state.overlaps},
            {"penetration_p99_mm", 1000 * state.penetration_p99},
            {"penetration_most_mm", 1000 * state.penetration_most},
            {"kinetic_energy_j", state.energy},
            {"mean_height_m", state.height},
            {"escaped", state.escaped}};
}

// times_...: below 1 ours is faster.
Json peersOf(const bench::PileRow& row) {
    Json peers = Json::array();
    for (const bench::PilePeer& peer : row.peers)
        peers.push_back(
            {{"peer", peer.name}, {"ms_per_step", peer.ms}, {"times_peer", row.ms / peer.ms}, {"end", toJson(peer.state)}});
    return peers;
}

Json toJson(const bench::PileRow& row) {
    return {{"bodies", row.bodies},         {"steps", row.steps},       {"ms_per_step", row.ms},
            {"dispatches", row.dispatches}, {"pairs", row.pairs},       {"contacts", row.contacts},
            {"colors", row.colors},         {"end", toJson(row.state)}, {"stages", sharesOf("stage", row.stages)},
            {"peers", peersOf(row)}};
}

Json toJson(const bench::BroadPhaseRow& row) {
    Json json = {{"boxes", row.boxes}, {"pairs", row.pairs}, {"ms", row.ms}, {"us_per_box", 1000 * row.ms / row.boxes}};
    if (row.bullet_ms == 0) return json;
    json["bullet_pairs"] = row.bullet_pairs;
    json["bullet_build_ms"] = row.bullet_build_ms;
    json["times_bullet_build"] = row.ms / row.bullet_build_ms;
    json["bullet_ms"] = row.bullet_ms;
    json["times_bullet"] = row.ms / row.bullet_ms;
    return json;
}

Json toJson(const bench::NarrowPhaseRow& row) {
    return {{"pairs", row.pairs}, {"touching", row.touching}, {"ms", row.ms}, {"us_per_pair", 1000 * row.ms / row.pairs}};
}

template <class Row>
Json reportOf(const std::vector<Row>& rows, auto count) {
    Json list = Json::array();
    for (size_t k = 0; k < rows.size(); ++k) {
        list.push_back(toJson(rows[k]));
        if (k > 0) addGrowth(list.back(), rows[k - 1].*count, rows[k - 1].ms, rows[k].*count, rows[k].ms);
    }
    return list;
}

} // namespace

Json sharesOf(const char* what, const bench::Times& times) {
    double sum = 0;
    for (const auto& [name, ms] : times)
        sum += ms;
    Json rows = Json::array();
    for (const auto& [name, ms] : times)
        rows.push_back({{what, name}, {"ms", ms}, {"share", sum > 0 ? ms / sum : 0}});
    return rows;
}

Json breakingReport(const std::vector<bench::BreakingRow>& rows) {
    Json list = Json::array();
    for (const bench::BreakingRow& row : rows)
        list.push_back({{"bodies", row.what.bodies},
                        {"cells", row.what.cells},
                        {"bystanders", row.what.bystanders},
                        {"effects", row.effects},
                        {"broken", row.broken},
                        {"fragments", row.fragments},
                        {"p50_ms", row.p50_ms},
                        {"p99_ms", row.p99_ms},
                        {"p99_less_p50_ms", row.p99_ms - row.p50_ms},
                        {"before_ms", row.before_ms},
                        {"break_ms", row.break_ms},
                        {"next_ms", row.next_ms},
                        {"after_ms", row.after_ms},
                        {"bytes", row.bytes},
                        {"stages", sharesOf("stage", row.stages)},
                        {"next_stages", sharesOf("stage", row.next_stages)}});
    return list;
}

Json pilesReport(const std::vector<bench::PileRow>& rows) { return reportOf(rows, &bench::PileRow::bodies); }
Json broadPhaseReport(const std::vector<bench::BroadPhaseRow>& rows) { return reportOf(rows, &bench::BroadPhaseRow::boxes); }
Json narrowPhaseReport(const std::vector<bench::NarrowPhaseRow>& rows) { return reportOf(rows, &bench::NarrowPhaseRow::pairs); }

} // namespace cli
