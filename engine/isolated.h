// Runs code that cannot be trusted with broken input in a process of its own: whatever it does there, crash, hang or eat all
// memory, the caller lives on and learns of it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace engine {

struct IsolationLimits {
    uint32_t seconds = 120;
    uint64_t bytes = uint64_t{8} << 30; // of address space, beyond what the process has already
};

struct IsolatedRun {
    enum class End {
        Done,
        Died, // crashed, was killed, or threw
        OutOfTime,
        OutOfMemory,
        Unwanted,
        NotBegun, // the system has no more processes or pipes
    };
    End end = End::Died;
    std::string answer; // what `work` returned, bytes and all, where it is done
    bool isDone() const { return end == End::Done; }
};

// A process that answers one request after another. It is forked by the first one, from the thread that asks, as this process
// is then, and anew by the next one after it has come to an end: nothing is shared afterwards. It holds no open file of its
// parent's, must not touch a device, and ends with the thread that has forked it.
class IsolatedProcess {
public:
    using Work = std::function<std::string(std::string_view request)>;
    explicit IsolatedProcess(Work work, IsolationLimits limits = {}); // limits are of one request
    ~IsolatedProcess();
    IsolatedProcess(const IsolatedProcess&) = delete;
    IsolatedProcess& operator=(const IsolatedProcess&) = delete;

    // `is_unwanted` is asked every few milliseconds; once it says so, the process is ended. From one thread. `work` should take
    // no lock that another thread can hold while this process is forked; a child that waits for one, as for that of an
    // allocator that was not made for forks, is given up after a second and forked anew.
    IsolatedRun run(std::string_view request, const std::function<bool()>& is_unwanted = {});

private:
    bool begin();
    int end();
    IsolatedRun ask(std::string_view request, const std::function<bool()>& is_unwanted);
    struct Watch;
    IsolatedRun::End hearAnswer(Watch& watch, const std::function<bool()>& is_unwanted, std::string& answer) const;

    Work work_;
    IsolationLimits limits_;
    int child_ = -1, socket_ = -1;
};

// Of one request.
IsolatedRun runIsolated(const std::function<std::string()>& work, const IsolationLimits& limits = {},
                        const std::function<bool()>& is_unwanted = {});

// False under the address sanitizer, which reserves terabytes of addresses for itself.
bool isolationLimitsMemory();

} // namespace engine
