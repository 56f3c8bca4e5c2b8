#include "tools/accuracy/price_list.h"

#include "modules/brittle/export/output_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <span>

namespace accuracy {

const PickedFamily kFractureFamily = {"fracture", "corners off, of the diagonal, or cut faces turned over, of their area"};
const PickedFamily kDynamicsFamily = {"dynamics", "mm of overlap in a pile"};

namespace {

namespace fs = std::filesystem;

using engine::Result;

bool counts(const PickedFamily& family, const MeasuredError& error) {
    if (std::string(family.name) == kFractureFamily.name) return error.kind == "corners" || error.kind == "turned";
    return error.kind == "penetration";
}

// What a scene has or has not got is not for us to change.
bool isOfScene(const Measurement& m) { return m.knob == "ccd" || m.knob == "sleeping"; }

std::string slugOf(const std::string& text) {
    std::string slug;
    for (const char c : text)
        if (std::isalnum(static_cast<unsigned char>(c)) != 0)
            slug += c;
        else if (!slug.empty() && slug.back() != '_')
            slug += '_';
    return slug;
}

fs::path cacheFolder() {
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache != 0) return cache;
    if (const char* home = std::getenv("HOME"); home != nullptr && *home != 0) return fs::path(home) / ".cache";
    return {};
}

std::string shortText(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

std::string nameOf(const Price& price) { return price.knob == "default" ? "the default" : price.knob + " " + price.setting; }

// As accurate as the other one, or more.
bool isBetter(const Price& a, const Price& b) { return a.error != b.error ? a.error < b.error : a.times < b.times; }
bool isFaster(const Price& a, const Price& b) { return a.times < b.times; }

struct Sum {
    Price price;
    bool is_known = false, has_failed = false;
};

void add(Sum& sum, const Measurement& m, const PickedFamily& family) {
    sum.price.knob = m.knob;
    sum.price.setting = m.setting;
    sum.price.loses = m.loses;
    sum.has_failed = sum.has_failed || !m.failed.empty();
    if (!m.failed.empty()) return;
    bool told = false;
    for (const MeasuredError& error : m.errors) {
        if (!counts(family, error)) continue;
        sum.price.error = std::max({sum.price.error, error.value, error.resolution});
        told = true;
    }
    if (!told) return;
    sum.price.times = sum.is_known ? std::max(sum.price.times, m.times_default) : m.times_default;
    sum.is_known = true;
}

} // namespace

fs::path priceListPath(const std::string& device, const std::string& driver) {
    const fs::path folder = cacheFolder();
    return folder.empty() ? fs::path() : folder / "brittle" / ("prices_" + slugOf(device + " " + driver) + ".json");
}

void keepPriceList(const Results& results) {
    const fs::path path = priceListPath(results.machine.device, results.machine.driver);
    std::error_code ignored;
    if (!path.empty()) fs::create_directories(path.parent_path(), ignored);
    auto file = brittle::OutputFile::create(path);
    if (file && file->write(encodeResults(results))) (void)file->commit();
}

Result<Results> readPriceList(const engine::Device& device) {
    const fs::path path = priceListPath(device.name(), device.driver());
    if (path.empty() || !fs::exists(path))
        return engine::Error{engine::ErrorCode::BadInput,
                             "there are no prices of " + device.name() +
                                 " to pick a setting by; measure them once: brittle accuracy --quick"};
    return readResults(path);
}

std::vector<Price> pricesOf(const Results& results, const PickedFamily& family) {
    std::vector<Sum> sums;
    for (const Measurement& m : results.measurements) {
        const Workload* workload = workloadOf(results, m.workload);
        if (workload == nullptr || workload->family != family.name || isOfScene(m)) continue;
        const auto known = std::ranges::find_if(
            sums, [&](const Sum& sum) { return sum.price.knob == m.knob && sum.price.setting == m.setting; });
        add(known == sums.end() ? sums.emplace_back() : *known, m, family);
    }
    std::vector<Price> prices;
    for (const Sum& sum : sums)
        if (sum.is_known && !sum.has_failed) prices.push_back(sum.price);
    return prices;
}

Result<Choice> choose(const std::vector<Price>& prices, const PickedFamily& family, double usual_ms, const Wish& wish) {
    std::vector<Price> left = prices;
    if (wish.tolerance) std::erase_if(left, [&](const Price& price) { return price.error > *wish.tolerance; });
    if (left.empty()) {
        const auto best = std::ranges::min_element(prices, isBetter);
        return engine::Error{
            engine::ErrorCode::BadInput,
            "no setting is within a tolerance of " + shortText(wish.tolerance.value_or(0)) +
                (best == prices.end() ? "" : "; the least, " + shortText(best->error) + ", has " + nameOf(*best)) + " (" +
                family.error + ")"};
    }
    Choice choice;
    choice.usual_ms = usual_ms;
    const Price fastest = *std::ranges::min_element(left, isFaster);
    const std::string within = wish.tolerance ? "within a tolerance of " + shortText(*wish.tolerance) : "";
    if (wish.budget_ms) {
        std::vector<Price> fitting = left;
        std::erase_if(fitting, [&](const Price& price) { return price.times * usual_ms > *wish.budget_ms; });
        choice.keeps_budget = !fitting.empty();
        choice.price = fitting.empty() ? fastest : *std::ranges::min_element(fitting, isBetter);
        choice.why = (fitting.empty() ? "nothing keeps to " : "the most accurate that keeps to ") + shortText(*wish.budget_ms) +
                     " ms" + (within.empty() ? "" : " " + within) + (fitting.empty() ? ", and this is the fastest" : "");
    } else {
        choice.price = fastest;
        choice.why = "the fastest " + within;
    }
    choice.expected_ms = choice.price.times * usual_ms;
    return choice;
}

std::string choiceText(const Choice& choice, const PickedFamily& family, const Machine& measured_on) {
    return nameOf(choice.price) + ": " + shortText(choice.expected_ms) + " ms expected, " + shortText(choice.usual_ms) +
           " by default, error " + shortText(choice.price.error) + " (" + family.error + "), " + choice.why +
           ". What one loses: " + choice.price.loses + " Prices of " + measured_on.date +
           (measured_on.is_quick ? ", a quick run" : "");
}

} // namespace accuracy
