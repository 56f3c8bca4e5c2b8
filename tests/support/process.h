// Runs a program of the build and catches what it says.
#pragma once

#include <string>
#include <vector>

namespace support {

struct Outcome {
    int exit_code = -1; // -1: it did not end by itself (a signal)
    std::string out, err;
};

// `program` stands in the build's bin folder; `environment` holds NAME=VALUE. Nothing on standard input.
Outcome runProgram(const std::string& program, const std::vector<std::string>& arguments,
                   const std::vector<std::string>& environment = {});

std::string fileBytes(const std::string& path); // empty where there is none

} // namespace support
