#include "tools/brittle/auto_setting.h"

#include "tools/accuracy/dynamics_settings.h"
#include "tools/accuracy/fracture_settings.h"
#include "tools/brittle/command.h"

#include <algorithm>
#include <cstdio>

namespace cli {
namespace {

constexpr double kMostMs = 1e6, kMostError = 1e9;

template <class Settings>
auto findByName(const Settings& settings, const accuracy::Price& price) {
    return std::ranges::find_if(
        settings, [&](const auto& setting) { return setting.knob == price.knob && setting.setting == price.setting; });
}

// The setting of that name, which is there: nothing else is picked.
template <class Settings, class Target>
void applyByName(const Settings& settings, const accuracy::Price& price, Target& target) {
    const auto found = findByName(settings, price);
    if (found != settings.end()) found->apply(target);
}

// Prices that another version has measured may be of settings that this one has not got.
bool isOurs(const accuracy::Price& price, const accuracy::PickedFamily& family) {
    const auto has = [&](const auto& settings) { return findByName(settings, price) != settings.end(); };
    return &family == &accuracy::kFractureFamily ? has(accuracy::fractureSettings()) : has(accuracy::dynamicsSettings());
}

void addWish(CLI::App& command, const char* name, std::optional<double>& wish, double most, const std::string& help) {
    inRange(command.add_option(name, wish, help), 0, most);
}

} // namespace

void addAutoOptions(CLI::App& command, accuracy::Wish& wish, const std::string& per, const std::string& error) {
    addWish(command, "--budget-ms", wish.budget_ms, kMostMs,
            "pick the most accurate setting that takes no longer for " + per +
                ", by the prices of this device (brittle accuracy)");
    addWish(command, "--tolerance", wish.tolerance, kMostError,
            "pick the fastest setting that errs by no more than this, of " + error);
}

engine::Result<AutoReport> pickSetting(const engine::Device& device, const accuracy::PickedFamily& family, double usual_ms,
                                       const accuracy::Wish& wish) {
    const auto list = accuracy::readPriceList(device);
    if (!list) return list.error();
    std::vector<accuracy::Price> prices = accuracy::pricesOf(*list, family);
    std::erase_if(prices, [&](const accuracy::Price& price) { return !isOurs(price, family); });
    if (prices.empty())
        return engine::Error{engine::ErrorCode::BadInput,
                             accuracy::priceListPath(device.name(), device.driver()).string() + ": holds no price of " +
                                 family.name + " that this version knows; measure anew: brittle accuracy --quick"};
    const auto choice = accuracy::choose(prices, family, usual_ms, wish);
    if (!choice) return choice.error();
    return AutoReport{*choice, choiceText(*choice, family, list->machine), usual_ms, {}};
}

void applyTo(brittle::FractureOptions& options, const accuracy::Price& price) {
    applyByName(accuracy::fractureSettings(), price, options);
}

void applyTo(brittle::StepSettings& settings, const accuracy::Price& price) {
    applyByName(accuracy::dynamicsSettings(), price, settings);
}

nlohmann::ordered_json autoJson(const AutoReport& report) {
    const accuracy::Choice& choice = report.choice;
    nlohmann::ordered_json json = {
        {"knob", choice.price.knob},         {"setting", choice.price.setting}, {"why", choice.why},
        {"loses", choice.price.loses},       {"error", choice.price.error},     {"usual_ms", choice.usual_ms},
        {"expected_ms", choice.expected_ms}, {"taken_ms", report.taken_ms},     {"keeps_budget", choice.keeps_budget}};
    if (!report.fell_back.empty()) json["fell_back"] = report.fell_back;
    return json;
}

void printAuto(const AutoReport& report) {
    std::printf("picked     %s\n", report.text.c_str());
    std::printf("           it took %.3g ms\n", report.taken_ms);
    if (!report.fell_back.empty()) std::printf("           the default was taken instead: %s\n", report.fell_back.c_str());
}

} // namespace cli
