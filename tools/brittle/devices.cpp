// brittle devices: what there is to run on.
#include "engine/device.h"
#include "tools/brittle/command.h"
#include "tools/device_check/device_facts.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace cli {
namespace {

constexpr uint32_t kNone = ~0u;

void printJson(const std::vector<engine::DeviceInfo>& devices, uint32_t chosen) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const engine::DeviceInfo& d : devices)
        list.push_back({{"index", d.index},
                        {"name", d.name},
                        {"driver", d.driver},
                        {"cpu", d.cpu},
                        {"usable", d.usable},
                        {"why_not", d.why_not},
                        {"chosen", d.index == chosen}});
    std::printf("%s\n", list.dump(2).c_str());
}

void printText(const std::vector<engine::DeviceInfo>& devices, uint32_t chosen) {
    for (const engine::DeviceInfo& d : devices) {
        const std::string state = !d.usable ? "not usable: " + d.why_not : d.index == chosen ? "chosen" : "usable";
        std::printf("%u  %s, %s%s: %s\n", d.index, d.name.c_str(), d.driver.c_str(), d.cpu ? " (CPU)" : "", state.c_str());
    }
}

int runDevices(const std::string& wanted, bool as_json) {
    const std::vector<engine::DeviceInfo> devices = engine::listDevices();
    const auto chosen = engine::Device::create({.select = wanted});
    if (devices.empty() && !chosen) return fail(chosen.error());
    const uint32_t index = chosen ? device_check::indexOf(**chosen) : kNone;
    as_json ? printJson(devices, index) : printText(devices, index);
    return chosen ? kOk : fail(chosen.error());
}

} // namespace

void addDevices(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("devices", "List the devices and say which is used, and why not the others.");
    command->footer("Example:\n  brittle devices --device llvmpipe");
    auto wanted = std::make_shared<std::string>();
    auto as_json = std::make_shared<bool>(false);
    command->add_option("--device", *wanted, "a part of the name, or the index; else $BRITTLE_DEVICE, else the fastest");
    command->add_flag("--json", *as_json, "print JSON");
    command->callback([wanted, as_json, &exit_code] { exit_code = runDevices(*wanted, *as_json); });
}

} // namespace cli
