// Starts a program with this process's environment and settings of its own.
#pragma once

#include <spawn.h>
#include <string>
#include <sys/types.h>
#include <vector>

namespace device_check {

// `words`: the program's path, then its arguments. `settings`: NAME=VALUE; each replaces an inherited or an earlier one of the
// same name. `files` and `attributes`: as of posix_spawn; `attributes` may be null. Returns 0 and the process in `pid`, or an
// errno value. Safe from several threads at a time.
int spawnProgram(std::vector<std::string> words, const std::vector<std::string>& settings,
                 const posix_spawn_file_actions_t& files, const posix_spawnattr_t* attributes, pid_t& pid);

struct ChildStreams {
    int output, errors; // descriptors that the program gets as standard output and standard error
};

// Starts a program in a process group of its own, with default signals and an empty standard input. The kernel ends it if the
// calling thread ends, so that nothing goes on after SIGKILL to this process. Otherwise as spawnProgram.
int spawnFollower(std::vector<std::string> words, const std::vector<std::string>& settings, ChildStreams streams, pid_t& pid);

} // namespace device_check
