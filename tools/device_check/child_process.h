// Runs a program with a time limit and hands on what it prints line by line, so that a program that hangs loses nothing.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace device_check {

using Clock = std::chrono::steady_clock;

struct ChildCommand {
    std::vector<std::string> words;       // the program's path, then its arguments
    std::vector<std::string> environment; // NAME=VALUE, in addition to this process's own
    Clock::time_point until;              // ended then
    std::chrono::seconds patience{0};     // ended if it prints no line for so long; 0: no such limit
};

struct ChildEnd {
    enum class Kind {
        Exited,     // by itself, with `code`
        Signaled,   // by the signal `code`
        OutOfTime,  // ended at `until`
        Silent,     // ended after `patience`
        NotStarted, // `reason` says why
    };
    Kind kind = Kind::NotStarted;
    int code = 0;
    double seconds = 0;
    std::string errors; // the last 4 KiB of its standard error
    std::string reason; // one line, for people; empty if it exited with 0

    bool isGood() const { return kind == Kind::Exited && code == 0; }
};

using LineHandler = std::function<void(std::string_view line)>;

// Blocks until the program has ended. Its standard input is empty. `line` is called on this thread, without the line break,
// for each line of standard output; an unfinished last line counts. If the program is ended, its children are ended as well.
// If this process ends, or the calling thread, the kernel ends the program.
// A program that does not end after SIGKILL (a driver that hangs) is left behind after five seconds. Safe from several
// threads at a time.
ChildEnd runChild(const ChildCommand& command, const LineHandler& line);

// Ends all programs that runChild runs now, with their children, and starts no more. Call it once, before this process ends:
// runChild does not return any more.
void endChildren();

// The path of this program. Empty if the system does not tell.
std::string ownPath();

} // namespace device_check
