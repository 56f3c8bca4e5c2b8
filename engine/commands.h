// Records work for the compute queue: dispatches, fills and copies, with the barriers between them derived from what each
// kernel says it reads and writes, and device time by label.
//
// Mistakes of the caller (a wrong number of buffers, a push block of another size, an empty view) do not throw and do not
// stop the recording: the first one is kept, and status() and submitAndWait() return it.
#pragma once

#include "engine/buffer.h"
#include "engine/descriptors.h"
#include "engine/hazards.h"
#include "engine/kernel.h"
#include "engine/timestamps.h"

#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace engine {

struct NoPush {};

// A command as it was recorded, for whoever wants to know what a recording is made of.
struct TracedCommand {
    enum class Kind : uint8_t { Lanes, Groups, Indirect, Fill, Copy };
    Kind kind = Kind::Groups;
    std::string label;               // that it lies in
    const Kernel* kernel = nullptr;  // none of fills and copies
    uint32_t count = 0;              // lanes or workgroups
    BufferView arguments;            // of what is dispatched indirectly
    std::vector<BufferView> buffers; // by binding; of a fill the target, of a copy source and target
};

// Is shown every command of a recording before and after the device runs it. Nothing else runs meanwhile, so that what a
// command has done can be read from its buffers.
class CommandProbe {
public:
    virtual ~CommandProbe() = default;
    // An error ends the recording: it is the one that status() and submitAndWait() return. A command that was refused has no
    // `after`.
    virtual Result<void> before(const TracedCommand& command) = 0;
    virtual Result<void> after(const TracedCommand& command) = 0;
};

class Commands {
public:
    // ByOthers: a secondary command buffer, which command buffers of others execute, several of them at a time; nothing in it
    // is timed.
    enum class Reuse : uint8_t { Once, Many, ByOthers };

    // With a command buffer of its own, for the compute queue.
    explicit Commands(Device& device);
    // Only records, into a command buffer of the caller, who has begun it, ends it and submits it to the compute queue. What
    // was dispatched may not be replaced (KernelLibrary::adopt) before the device has finished, unless this still exists then.
    Commands(Device& device, VkCommandBuffer external);
    ~Commands();
    Commands(const Commands&) = delete;
    Commands& operator=(const Commands&) = delete;

    // Starts a recording; what was recorded before must have finished, and its timings are forgotten.
    Result<void> begin(Reuse reuse = Reuse::Once);
    // Ends the recording, submits it, waits for the device, and makes all that it wrote visible to the host.
    Result<void> submitAndWait();
    // The same in two steps.
    Result<void> submit();
    Result<void> wait();
    // What was begun with Reuse::Many and submitted, once more; the device must have finished with it.
    Result<void> submitAgain();
    // Ends what was begun with Reuse::ByOthers. It may be executed from now on, as long as this is neither begun again nor
    // destroyed before those command buffers have finished.
    Result<void> end();
    // Records into a primary command buffer of the compute family, outside of render passes: after all that was submitted or
    // recorded before and before all that is after.
    void executeIn(VkCommandBuffer primary) const;
    // What is recorded from here on comes after all that was recorded or submitted before, by whomever.
    void separate() { separate(commands_); }
    // The first mistake of this recording.
    Result<void> status() const;

    // As many lanes as asked for, rounded up to whole workgroups; none record nothing.
    template <class Push>
    void dispatch(const Kernel& kernel, uint32_t invocations, const Push& push, std::initializer_list<BufferView> buffers) {
        dispatch(kernel, invocations, bytesOf(push), {buffers.begin(), buffers.size()});
    }
    template <class Push>
    void dispatchGroups(const Kernel& kernel, uint32_t groups, const Push& push, std::initializer_list<BufferView> buffers) {
        dispatchGroups(kernel, groups, bytesOf(push), {buffers.begin(), buffers.size()});
    }
    // `args` holds three words: the number of workgroups in x, y and z.
    template <class Push>
    void dispatchIndirect(const Kernel& kernel, BufferView args, const Push& push, std::initializer_list<BufferView> buffers) {
        dispatchIndirect(kernel, args, bytesOf(push), {buffers.begin(), buffers.size()});
    }

    using Bytes = std::span<const std::byte>;
    using Views = std::span<const BufferView>;
    void dispatch(const Kernel& kernel, uint32_t invocations, Bytes push, Views buffers);
    void dispatchGroups(const Kernel& kernel, uint32_t groups, Bytes push, Views buffers);
    void dispatchIndirect(const Kernel& kernel, BufferView args, Bytes push, Views buffers);

    // Whole words only. Empty views record nothing.
    void fill(BufferView target, uint32_t value);
    void copy(BufferView source, BufferView target);
    // Whole words, 64 KiB at most, which the recording keeps.
    void update(BufferView target, Bytes bytes);

    // Device time between the two, under this name. Labels do not nest.
    void beginLabel(std::string_view name);
    void endLabel();
    // From the next label on, spans are the kernels that lie in labels, under their own names, instead of the labels: what
    // takes the time, at the price of two timestamps a dispatch.
    void timeKernels() { time_kernels_ = true; }
    // From here on every command is noted down as well.
    void keepTrace() { trace_.emplace(); }
    std::span<const TracedCommand> trace() const { return trace_ ? *trace_ : std::span<const TracedCommand>(); }
    // Submits every command from here to the end of the recording on its own, waits for it, and shows it to `probe`, which
    // outlives the recording. Of recordings that were begun with Reuse::Once; nothing in them is timed.
    void showTo(CommandProbe& probe) { probe_ = &probe; }
    // Once the device has finished.
    Result<std::vector<Timing>> timings() const { return timestamps_.read(); }
    // The same one by one, in ms and in the order of the recording: of labels, or of dispatches where kernels are timed.
    Result<std::vector<double>> spanTimes() const { return timestamps_.spans(); }

    // Makes all that was recorded visible to every later command and to the host. An own recording ends with it; a caller's
    // command buffer needs it before commands that were not recorded here.
    void flush();

    // Hands buffers from the compute to the graphics family, and takes them over there: record the first into a compute and
    // the second into a graphics command buffer that is submitted after it. Nothing to do where the families are one.
    void releaseToGraphics(std::span<const BufferView> buffers);
    static void acquireFromCompute(const Device& device, VkCommandBuffer graphics, std::span<const BufferView> buffers);

    VkCommandBuffer handle() const { return commands_; }
    uint32_t dispatchCount() const { return dispatch_count_; }
    uint32_t barrierCount() const { return barrier_count_; }

private:
    template <class Push>
    static Bytes bytesOf(const Push& push) {
        static_assert(std::is_trivially_copyable_v<Push>);
        if constexpr (std::is_empty_v<Push>)
            return {};
        else
            return std::as_bytes(std::span(&push, 1));
    }
    void separate(VkCommandBuffer commands) const;
    void fail(Error error);
    void failKernel(const Kernel& kernel, const std::string& why);
    bool accepts(const Kernel& kernel, Bytes push, Views buffers);
    bool acceptsView(const Kernel& kernel, uint32_t slot, const BufferView& view);
    bool prepare(const Kernel& kernel, Bytes push, Views buffers, const BufferView* args);
    bool bindBuffers(const Kernel& kernel, Views buffers);
    void dispatchGrid(const Kernel& kernel, uint32_t groups, Bytes push, Views buffers);
    void note(TracedCommand::Kind kind, const Kernel* kernel, uint32_t count, Views buffers, const BufferView& arguments = {});
    void runAlone();
    Result<void> runRecorded();
    void declare(std::span<const Access> accesses);
    void beginSpan(std::string_view name);
    Result<void> createOwn(bool secondary);

    Device& device_;
    bool external_ = false;
    bool secondary_ = false; // the one of its own
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    bool recording_ = false;
    bool time_kernels_ = false;
    HazardTracker hazards_;
    DescriptorPools descriptors_;
    std::vector<std::shared_ptr<const Pipeline>> pipelines_; // that it was recorded with, which may be replaced meanwhile
    Timestamps timestamps_;
    std::optional<Error> error_;
    std::optional<std::vector<TracedCommand>> trace_;
    CommandProbe* probe_ = nullptr;
    std::optional<TracedCommand> probed_; // shown, and not run yet
    std::string label_;
    uint32_t dispatch_count_ = 0;
    uint32_t barrier_count_ = 0;
};

} // namespace engine
