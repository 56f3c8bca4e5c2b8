#include "tests/support/process.h"

#include "tools/device_check/spawn.h"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <spawn.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace support {
std::string fileBytes(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string programPath(const std::string& program) { return std::filesystem::path(BRITTLE_BINARY_DIR) / program; }

RunningProgram::RunningProgram(const std::string& program, const std::vector<std::string>& arguments,
                               const std::vector<std::string>& environment) {
    static std::atomic<int> runs = 0;
    base_ = testing::TempDir() + "brittle_run_" + std::to_string(getpid()) + "_" + std::to_string(runs++);
    std::vector<std::string> words{programPath(program)};
    words.insert(words.end(), arguments.begin(), arguments.end());
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    constexpr int kFresh = O_WRONLY | O_CREAT | O_TRUNC;
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, (base_ + ".out").c_str(), kFresh, 0600);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, (base_ + ".err").c_str(), kFresh, 0600);
    const int failed = device_check::spawnProgram(words, environment, files, nullptr, pid_);
    posix_spawn_file_actions_destroy(&files);
    if (failed == 0) return;
    pid_ = -1;
    ADD_FAILURE() << words[0] << ": " << std::strerror(failed);
}

RunningProgram::~RunningProgram() {
    if (pid_ != -1) {
        kill(pid_, SIGKILL);
        hasEnded(true);
    }
    std::remove((base_ + ".out").c_str());
    std::remove((base_ + ".err").c_str());
}

bool RunningProgram::hasEnded(bool wait) {
    if (pid_ == -1) return true;
    int status = 0;
    if (waitpid(pid_, &status, wait ? 0 : WNOHANG) != pid_) return false;
    pid_ = -1;
    exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return true;
}

bool RunningProgram::says(const std::string& part, std::chrono::seconds patience) {
    const auto until = std::chrono::steady_clock::now() + patience;
    for (;;) {
        const bool is_last_look = hasEnded(false) || std::chrono::steady_clock::now() > until;
        if (fileBytes(base_ + ".out").find(part) != std::string::npos) return true;
        if (is_last_look) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

void RunningProgram::interrupt() const {
    if (pid_ != -1) kill(pid_, SIGINT);
}

Outcome RunningProgram::wait() {
    hasEnded(true);
    return {exit_code_, fileBytes(base_ + ".out"), fileBytes(base_ + ".err")};
}

Outcome runProgram(const std::string& program, const std::vector<std::string>& arguments,
                   const std::vector<std::string>& environment) {
    return RunningProgram(program, arguments, environment).wait();
}

} // namespace support
