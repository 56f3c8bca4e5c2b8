// Runs a program of the build and catches what it says.
#pragma once

#include <chrono>
#include <string>
#include <sys/types.h>
#include <vector>

namespace support {

struct Outcome {
    int exit_code = -1; // -1: it did not end by itself (a signal)
    std::string out, err;
};

// A program of the build's bin folder. An absolute path stays as it is.
std::string programPath(const std::string& program);

// A program at work, for tests that talk with it. `program`: as for programPath. `environment` holds NAME=VALUE. Nothing
// on standard input.
class RunningProgram {
public:
    RunningProgram(const std::string& program, const std::vector<std::string>& arguments,
                   const std::vector<std::string>& environment = {});
    ~RunningProgram();
    RunningProgram(const RunningProgram&) = delete;
    RunningProgram& operator=(const RunningProgram&) = delete;

    // Waits until its standard output holds this; false where it ends or the patience does before.
    bool says(const std::string& part, std::chrono::seconds patience);
    void interrupt() const; // as Ctrl+C does
    Outcome wait();

private:
    bool hasEnded(bool wait);

    std::string base_;
    pid_t pid_ = -1;
    int exit_code_ = -1;
};

Outcome runProgram(const std::string& program, const std::vector<std::string>& arguments,
                   const std::vector<std::string>& environment = {});

std::string fileBytes(const std::string& path); // empty where there is none

} // namespace support
