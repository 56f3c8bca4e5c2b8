#include "tests/support/process.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sys/wait.h>
#include <unistd.h>

namespace support {
namespace {

std::string quoted(const std::string& word) {
    std::string result = "'";
    for (const char c : word)
        result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
}

} // namespace

std::string fileBytes(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

Outcome runProgram(const std::string& program, const std::vector<std::string>& arguments,
                   const std::vector<std::string>& environment) {
    static std::atomic<int> runs = 0;
    const std::string base = testing::TempDir() + "brittle_run_" + std::to_string(getpid()) + "_" + std::to_string(runs++);
    std::string command = "env";
    for (const std::string& setting : environment)
        command += " " + quoted(setting);
    command += " " + quoted(std::string(BRITTLE_BINARY_DIR) + "/" + program);
    for (const std::string& argument : arguments)
        command += " " + quoted(argument);
    command += " >" + quoted(base + ".out") + " 2>" + quoted(base + ".err") + " </dev/null";
    const int status = std::system(command.c_str());
    // The shell tells of a signal by an exit code above 128.
    const bool ended = WIFEXITED(status) && WEXITSTATUS(status) <= 128;
    Outcome outcome{ended ? WEXITSTATUS(status) : -1, fileBytes(base + ".out"), fileBytes(base + ".err")};
    std::remove((base + ".out").c_str());
    std::remove((base + ".err").c_str());
    return outcome;
}

} // namespace support
