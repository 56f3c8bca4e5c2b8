#include "tools/accuracy/machine.h"

#include "tools/accuracy/program_version.h"

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <thread>
#include <unistd.h>

namespace accuracy {
namespace {

constexpr double kGib = 1024.0 * 1024 * 1024;

// What follows the key in the first line that begins with it, without quotes; empty where there is none.
std::string valueIn(const char* file, const std::string& key) {
    std::ifstream lines(file);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with(key)) continue;
        std::string value = line.substr(line.find_first_of("=:") + 1);
        std::erase(value, '"');
        return value.substr(std::min(value.find_first_not_of(" \t"), value.size()));
    }
    return "";
}

std::string systemName() {
    utsname name{};
    uname(&name);
    const std::string pretty = valueIn("/etc/os-release", "PRETTY_NAME");
    return (pretty.empty() ? "" : pretty + ", ") + name.sysname + " " + name.release + " " + name.machine;
}

std::string today() {
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &utc);
    return text;
}

} // namespace

Machine describeMachine(const engine::Device& device) {
    Machine machine;
    machine.processor = valueIn("/proc/cpuinfo", "model name");
    if (machine.processor.empty()) machine.processor = "unknown";
    machine.system = systemName();
    machine.device = device.name();
    machine.driver = device.driver();
    const ProgramVersion program = programVersion();
    machine.compiler = program.compiler;
    machine.brittle = program.version;
    machine.commit = program.commit;
    machine.date = today();
    machine.cores = std::thread::hardware_concurrency();
    machine.memory_gib = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE)) / kGib;
    double load = 0;
    if (getloadavg(&load, 1) == 1) machine.load_before = load;
    return machine;
}

double processorSeconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

} // namespace accuracy
