#include "modules/brittle/dynamics/world_state.h"

#include "modules/brittle/fracture/fetch.h"
#include "modules/brittle/fracture/upload.h"
#include "modules/brittle/mesh/byte_hash.h"

#include <cstring>
#include <numeric>
#include <string>

namespace brittle {
namespace {

using engine::Error;
using engine::ErrorCode;
using engine::Result;

constexpr uint64_t kMark = 0x32657461'74537242; // "BrState2"

Error otherContents(const std::string& what) {
    return {ErrorCode::BadInput,
            what + "; restore a state into a world of the contents, settings and budget that it was saved of"};
}

// The mark, what was heard, how many buffers, and the size of each.
constexpr size_t kBeforeSizes = 3;
size_t headBytes(size_t buffers) { return sizeof(uint64_t) * (kBeforeSizes + buffers); }

Result<void> checkSizes(std::span<const uint64_t> sizes, uint64_t bytes, std::span<const StateView> views) {
    const uint64_t needed = std::accumulate(sizes.begin(), sizes.end(), uint64_t{0});
    if (needed != bytes)
        return otherContents("a state that should have " + std::to_string(needed) + " bytes behind its head has " +
                             std::to_string(bytes));
    for (size_t k = 0; k < views.size(); ++k)
        if (!views[k].grows && sizes[k] != views[k].view.size)
            return otherContents("list " + std::to_string(k) + " of the state has " + std::to_string(sizes[k]) +
                                 " bytes, this world's " + std::to_string(views[k].view.size));
    return {};
}

} // namespace

Result<std::vector<std::byte>> readState(engine::Device& device, std::span<const StateView> views, const HeardSoFar& heard) {
    const uint64_t heard_word = uint64_t{heard.impacts} << 32 | heard.breaks;
    std::vector<uint64_t> head = {kMark, heard_word, views.size()};
    uint64_t bytes = headBytes(views.size());
    for (const StateView& each : views) {
        head.push_back(each.view.size);
        bytes += each.view.size;
    }
    std::vector<std::byte> state(bytes);
    std::memcpy(state.data(), head.data(), headBytes(views.size()));
    std::vector<Fetch> wanted;
    size_t at = headBytes(views.size());
    for (const StateView& each : views) {
        wanted.push_back({each.view, state.data() + at, each.view.size});
        at += each.view.size;
    }
    if (auto read = fetch(device, wanted); !read) return read.error();
    return state;
}

Result<StateHead> headOf(std::span<const std::byte> state, std::span<const StateView> views) {
    std::vector<uint64_t> words(kBeforeSizes + views.size());
    const size_t head = headBytes(views.size());
    if (state.size() < head) return otherContents("a state of " + std::to_string(state.size()) + " bytes is none");
    std::memcpy(words.data(), state.data(), head);
    if (words[0] != kMark || words[2] != views.size()) return otherContents("these bytes are no state of such a world");
    const std::vector<uint64_t> sizes(words.begin() + kBeforeSizes, words.end());
    if (auto sound = checkSizes(sizes, state.size() - head, views); !sound) return sound.error();
    return StateHead{{static_cast<uint32_t>(words[1]), static_cast<uint32_t>(words[1] >> 32)}, sizes};
}

Result<void> writeState(engine::Device& device, std::span<const std::byte> state, std::span<const StateView> views) {
    const auto head = headOf(state, views);
    if (!head) return head.error();
    Upload upload;
    uint64_t at = headBytes(views.size());
    for (size_t k = 0; k < views.size(); ++k) {
        if (head->sizes[k] > views[k].view.size) return otherContents("lists of the state do not fit together");
        upload.add(state.subspan(at, head->sizes[k]), views[k].view.sub(0, head->sizes[k]));
        at += head->sizes[k];
    }
    return upload.send(device);
}

uint64_t hashOf(std::span<const std::byte> bytes) {
    ByteHash hash;
    hash.add(bytes);
    return hash.value();
}

} // namespace brittle
