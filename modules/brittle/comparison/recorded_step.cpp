#include "modules/brittle/comparison/recorded_step.h"

#include "modules/brittle/comparison/pass_alignment.h"

#include <algorithm>
#include <cstring>
#include <map>

namespace brittle {
namespace {

using engine::Result;
using Bytes = std::span<const std::byte>;

constexpr uint64_t kMostKept = 64u << 20;   // bytes of changed words
constexpr uint64_t kBatchBytes = 48u << 20; // of buffers whose contents are read in one run
constexpr uint32_t kMostRuns = 32;

uint32_t wordAt(Bytes bytes, size_t word) {
    uint32_t value = 0;
    std::memcpy(&value, bytes.data() + 4 * word, sizeof value);
    return value;
}

// Returns how many bytes were kept.
uint64_t keepWords(const CapturedBuffer& captured, RecordedBuffer& recorded) {
    for (uint32_t k = 0; k < captured.after.size() / 4; ++k) {
        const uint32_t before = wordAt(captured.before, k), after = wordAt(captured.after, k);
        if (before == after) continue;
        recorded.places.push_back(k);
        recorded.before.push_back(before);
        recorded.after.push_back(after);
    }
    recorded.has_words = true;
    return 12 * recorded.places.size();
}

std::vector<BufferId> allBuffers(const StepCapture& capture) {
    std::vector<BufferId> ids;
    for (uint32_t pass = 0; pass < capture.size(); ++pass)
        for (uint32_t k = 0; k < capture[pass].written.size(); ++k)
            ids.push_back({pass, k});
    return ids;
}

// Buffers from `at` on, at least one, until there are enough bytes for one run.
std::set<BufferId> batchFrom(const std::vector<BufferId>& ids, size_t& at, const StepCapture& capture) {
    std::set<BufferId> batch;
    for (uint64_t bytes = 0; at < ids.size() && (batch.empty() || bytes < kBatchBytes); ++at) {
        batch.insert(ids[at]);
        bytes += capture[ids[at].pass].written[ids[at].buffer].bytes;
    }
    return batch;
}

RecordedStep withoutWords(const StepCapture& first, const StepCapture& second) {
    RecordedStep recorded;
    for (size_t pass = 0; pass < first.size(); ++pass) {
        const Pass& made = first[pass].pass;
        RecordedPass kept = {keyOf(made), made.stage, made.kernel, {}};
        for (size_t k = 0; k < first[pass].written.size(); ++k) {
            const CapturedBuffer& buffer = first[pass].written[k];
            const bool is_stable = second[pass].written[k].hashes == buffer.hashes;
            kept.written.push_back({buffer.slot, buffer.buffer, buffer.bytes, buffer.hashes, is_stable});
        }
        recorded.passes.push_back(std::move(kept));
    }
    return recorded;
}

Result<void> addWords(ComparedWorld compared, const StepCapture& hashes, RecordedStep& recorded) {
    const std::vector<BufferId> ids = allBuffers(hashes);
    uint64_t kept = 0;
    uint32_t runs = 0;
    for (size_t at = 0; at < ids.size() && kept < kMostKept && runs < kMostRuns; ++runs) {
        const std::set<BufferId> batch = batchFrom(ids, at, hashes);
        const auto contents = captureContents(compared, recorded.state, batch);
        if (!contents) return contents.error();
        for (const BufferId& id : batch)
            if (kept < kMostKept)
                kept += keepWords((*contents)[id.pass].written[id.buffer], recorded.passes[id.pass].written[id.buffer]);
    }
    return {};
}

// The recorded buffer with its contents. What the other device did not change is taken to be what is there on this one: both
// began with the same bytes.
CapturedBuffer contentsOf(const RecordedBuffer& recorded, const CapturedBuffer& here) {
    CapturedBuffer buffer = {recorded.slot,   recorded.buffer, here.fields, here.bytes,
                             recorded.hashes, here.before,     here.before};
    for (size_t k = 0; k < recorded.places.size(); ++k) {
        const size_t at = size_t{4} * recorded.places[k];
        if (at + 4 > buffer.after.size()) continue;
        std::memcpy(buffer.before.data() + at, &recorded.before[k], 4);
        std::memcpy(buffer.after.data() + at, &recorded.after[k], 4);
    }
    return buffer;
}

class RecordedComparer {
public:
    RecordedComparer(ComparedWorld compared, const RecordedStep& recorded) : compared_(compared), recorded_(recorded) {}

    Result<StepComparison> run() {
        for (StepCapture& run : hashes_) {
            auto captured = captureHashes(compared_, recorded_.state);
            if (!captured) return captured.error();
            run = std::move(*captured);
        }
        findCandidates();
        for (size_t at = 0; at < candidates_.size() && found_.differing() < kMostRowsThatDiffer;)
            if (auto added = addBatch(at); !added) return added.error();
        keepFirstRows(found_);
        return std::move(found_);
    }

private:
    // Buffers of this device that have other hashes than the recorded ones.
    void findCandidates() {
        std::vector<std::string> keys_a, keys_b;
        for (const RecordedPass& pass : recorded_.passes)
            keys_a.push_back(pass.key);
        for (const CapturedPass& pass : hashes_[0])
            keys_b.push_back(keyOf(pass.pass));
        const auto pairs = alignKeys(keys_a, keys_b);
        found_.passes_a = static_cast<uint32_t>(keys_a.size());
        found_.passes_b = static_cast<uint32_t>(keys_b.size());
        found_.aligned = static_cast<uint32_t>(pairs.size());
        for (const auto& [pass_a, pass_b] : pairs) {
            partners_.emplace(pass_b, pass_a);
            const size_t buffers = std::min(recorded_.passes[pass_a].written.size(), hashes_[0][pass_b].written.size());
            for (uint32_t k = 0; k < buffers; ++k)
                addCandidate({pass_b, k});
        }
    }
    void addCandidate(const BufferId& id) {
        if (isSame(id)) return;
        if (isUnordered(hashes_[0][id.pass].written[id.buffer]))
            found_.rows.push_back(rowOf(id, DifferenceKind::Unordered));
        else
            candidates_.push_back(id);
    }
    const RecordedBuffer& recordedOf(const BufferId& id) const {
        return recorded_.passes[partners_.at(id.pass)].written[id.buffer];
    }
    bool isSame(const BufferId& id) const {
        const BufferHashes &a = recordedOf(id).hashes, &b = hashes_[0][id.pass].written[id.buffer].hashes;
        return a.whole == b.whole || a.changes == b.changes;
    }
    bool isStable(const BufferId& id) const {
        const BufferHashes& first = hashes_[0][id.pass].written[id.buffer].hashes;
        return recordedOf(id).is_stable && first == hashes_[1][id.pass].written[id.buffer].hashes;
    }
    Result<void> addBatch(size_t& at) {
        const std::set<BufferId> batch = batchFrom(candidates_, at, hashes_[0]);
        StepCapture runs[2];
        for (StepCapture& run : runs) {
            auto captured = captureContents(compared_, recorded_.state, batch);
            if (!captured) return captured.error();
            run = std::move(*captured);
        }
        for (const BufferId& id : batch)
            addRow(id, runs[0][id.pass].written[id.buffer], runs[1][id.pass].written[id.buffer]);
        return {};
    }
    BufferDifference rowOf(const BufferId& id, DifferenceKind kind) const {
        const RecordedBuffer& recorded = recordedOf(id);
        const RecordedPass& pass_a = recorded_.passes[partners_.at(id.pass)];
        const std::string& kernel_b = hashes_[0][id.pass].pass.kernel;
        return {kind, partners_.at(id.pass), id.pass, pass_a.stage, pass_a.kernel, kernel_b, recorded.slot, recorded.buffer};
    }
    void addRow(const BufferId& id, const CapturedBuffer& first, const CapturedBuffer& second) {
        const RecordedBuffer& recorded = recordedOf(id);
        BufferDifference row = rowOf(id, DifferenceKind::Differs);
        if (!recorded.has_words)
            row.kind = kindByHashes(id);
        else if (!classify({contentsOf(recorded, first)}, {first, &second}, row))
            return;
        // A recording holds only what a pass changed. If elements changed places earlier, the rest of them is taken from
        // others.
        if (row.kind == DifferenceKind::Differs && kindByHashes(id) == DifferenceKind::Reordered) {
            row.kind = DifferenceKind::Reordered;
            row.differing = 0;
            row.first.reset();
        }
        if (row.kind == DifferenceKind::Differs && !isStable(id)) row.kind = DifferenceKind::Unstable;
        found_.rows.push_back(std::move(row));
    }
    DifferenceKind kindByHashes(const BufferId& id) const {
        const bool is_reordered = recordedOf(id).hashes.unordered == hashes_[0][id.pass].written[id.buffer].hashes.unordered;
        return is_reordered ? DifferenceKind::Reordered : DifferenceKind::Differs;
    }

    ComparedWorld compared_;
    const RecordedStep& recorded_;
    StepCapture hashes_[2];
    std::map<uint32_t, uint32_t> partners_; // passes of this device, and which of the recorded ones they are
    std::vector<BufferId> candidates_;
    StepComparison found_;
};

} // namespace

Result<RecordedStep> recordStep(ComparedWorld compared, uint32_t step, Bytes state) {
    const auto first = captureHashes(compared, state), second = first ? captureHashes(compared, state) : first;
    if (!first) return first.error();
    if (!second) return second.error();
    RecordedStep recorded = withoutWords(*first, *second);
    recorded.step = step;
    recorded.state.assign(state.begin(), state.end());
    if (auto added = addWords(compared, *first, recorded); !added) return added.error();
    return recorded;
}

Result<StepComparison> compareWithRecorded(ComparedWorld compared, const RecordedStep& recorded) {
    return RecordedComparer(compared, recorded).run();
}

} // namespace brittle
