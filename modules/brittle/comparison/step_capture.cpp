#include "modules/brittle/comparison/step_capture.h"

#include "engine/buffer_values.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace brittle {
namespace {

using engine::BufferView;
using engine::Result;
using engine::TracedCommand;
using Bytes = std::span<const std::byte>;

uint64_t mixed(uint64_t word) {
    word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9u;
    word = (word ^ (word >> 27)) * 0x94d049bb133111ebu;
    return word ^ (word >> 31);
}

uint32_t wordOf(Bytes bytes, size_t word) {
    uint32_t value = 0;
    std::memcpy(&value, bytes.data() + 4 * word, sizeof value);
    return value;
}

uint64_t hashOfWords(Bytes bytes) {
    uint64_t hash = bytes.size();
    for (size_t k = 0; k < bytes.size() / 4; ++k) {
        hash = (hash ^ wordOf(bytes, k)) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 29;
    }
    return mixed(hash);
}

void addElement(Bytes before, Bytes after, size_t first_word, BufferHashes& hashes) {
    for (size_t k = 0; k < after.size() / 4; ++k)
        if (const uint32_t word = wordOf(after, k); word != wordOf(before, k))
            hashes.changes += mixed(mixed(first_word + k + 1) + word);
    hashes.unordered += hashOfWords(after);
}

bool areUnchanged(Bytes a, Bytes b) { return std::memcmp(a.data(), b.data(), a.size()) == 0; }

BufferHashes hashesOf(Bytes before, Bytes after, uint32_t element_bytes) {
    if (areUnchanged(before, after)) return {};
    BufferHashes hashes = {hashOfWords(after), 0, 0};
    for (size_t at = 0; at < after.size(); at += element_bytes) {
        const size_t size = std::min<size_t>(element_bytes, after.size() - at);
        if (const Bytes was = before.subspan(at, size), is = after.subspan(at, size); !areUnchanged(was, is))
            addElement(was, is, at / 4, hashes);
    }
    return hashes;
}

// Links of disjoint sets (lib/union_find.glsl) lead down, by ways that depend on the order in which lanes run. Only the roots
// are results, so this replaces each link by the root that it leads to.
class RootedLinks {
public:
    // The result is valid until the next call.
    Bytes of(Bytes links) {
        roots_.assign(links.begin(), links.end());
        for (size_t member = 0; member < roots_.size() / 4; ++member)
            if (const uint32_t link = wordOf(roots_, member); link < member)
                std::memcpy(roots_.data() + 4 * member, roots_.data() + size_t{4} * link, 4);
        return roots_;
    }

private:
    std::vector<std::byte> roots_;
};

// Copies of device memory, in a buffer that is kept from one pass to the next.
class Readback {
public:
    explicit Readback(engine::Device& device) : device_(device), commands_(device) {}

    // One after the other, each from a multiple of 16 bytes.
    Result<void> read(std::span<const BufferView> views) {
        begins_.assign(1, 0);
        for (const BufferView& view : views)
            begins_.push_back(begins_.back() + (view.size + 15) / 16 * 16);
        if (begins_.back() > buffer_.size())
            if (auto made = makeRoom(begins_.back()); !made) return made;
        if (auto begun = commands_.begin(); !begun) return begun;
        for (size_t k = 0; k < views.size(); ++k)
            commands_.copy(views[k], BufferView(buffer_).sub(begins_[k], views[k].size));
        device_.countReadBack(begins_.back());
        return commands_.submitAndWait();
    }
    Bytes contentsOf(size_t view, uint64_t bytes) const { return {buffer_.mapped() + begins_[view], bytes}; }

private:
    Result<void> makeRoom(VkDeviceSize bytes) {
        auto made = engine::Buffer::create(device_, bytes + bytes / 2, engine::BufferDomain::Readback, 0, "capture");
        if (!made) return made.error();
        buffer_ = std::move(*made);
        return {};
    }

    engine::Device& device_;
    engine::Commands commands_;
    engine::Buffer buffer_;
    std::vector<VkDeviceSize> begins_;
};

class Capture final : public PassProbe {
public:
    // `wanted`: nullptr for hashes of all buffers.
    Capture(engine::Device& device, const std::set<BufferId>* wanted) : wanted_(wanted), before_(device), after_(device) {}

    Result<void> before(const Pass& pass, const TracedCommand& command) override {
        passes_.push_back({pass, {}});
        views_.clear();
        places_.clear();
        for (size_t k = 0; k < pass.buffers.size(); ++k)
            if (pass.buffers[k].writes) add(command, k);
        return views_.empty() ? Result<void>() : before_.read(views_);
    }
    Result<void> after(const Pass&, const TracedCommand&) override {
        if (views_.empty()) return {};
        if (auto read = after_.read(views_); !read) return read;
        for (size_t k = 0; k < views_.size(); ++k)
            keep(before_.contentsOf(k, views_[k].size), after_.contentsOf(k, views_[k].size), places_[k]);
        return {};
    }
    StepCapture take() { return std::move(passes_); }

private:
    void add(const TracedCommand& command, size_t k) {
        CapturedPass& captured = passes_.back();
        const bool is_kernel = command.kernel != nullptr;
        const BufferView& view = is_kernel ? command.buffers[k] : command.buffers.back();
        CapturedBuffer buffer = {captured.pass.buffers[k].slot, captured.pass.buffers[k].buffer, {}, view.size};
        if (is_kernel) buffer.fields = command.kernel->reflection.bindings[k].fields;
        if (isWanted(captured.written.size())) {
            views_.push_back(view);
            places_.push_back(captured.written.size());
        }
        captured.written.push_back(std::move(buffer));
    }
    bool isWanted(size_t place) const {
        const BufferId id = {static_cast<uint32_t>(passes_.size() - 1), static_cast<uint32_t>(place)};
        return wanted_ == nullptr || wanted_->contains(id);
    }
    void keep(Bytes before, Bytes after, size_t place) {
        CapturedBuffer& buffer = passes_.back().written[place];
        if (buffer.slot == "parents") {
            before = rooted_[0].of(before);
            after = rooted_[1].of(after);
        }
        if (wanted_ == nullptr) {
            buffer.hashes = hashesOf(before, after, engine::elementBytes(buffer.fields));
            return;
        }
        buffer.before.assign(before.begin(), before.end());
        buffer.after.assign(after.begin(), after.end());
    }

    const std::set<BufferId>* wanted_;
    Readback before_, after_;
    // Views that the current pass writes, and their indices in CapturedPass::written.
    std::vector<BufferView> views_;
    std::vector<size_t> places_;
    StepCapture passes_;
    RootedLinks rooted_[2]; // before and after a pass
};

Result<StepCapture> capture(ComparedWorld compared, Bytes state, const std::set<BufferId>* wanted) {
    if (auto restored = compared.world.restore(state); !restored) return restored.error();
    Capture probe(compared.device, wanted);
    if (auto stepped = compared.world.probeStep(probe); !stepped) return stepped.error();
    return probe.take();
}

} // namespace

Result<StepCapture> captureHashes(ComparedWorld compared, Bytes state) { return capture(compared, state, nullptr); }

Result<StepCapture> captureContents(ComparedWorld compared, Bytes state, const std::set<BufferId>& wanted) {
    return capture(compared, state, &wanted);
}

} // namespace brittle
