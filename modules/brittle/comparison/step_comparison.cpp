#include "modules/brittle/comparison/step_comparison.h"

#include "engine/buffer_values.h"
#include "modules/brittle/comparison/pass_alignment.h"

#include <algorithm>
#include <array>

namespace brittle {
namespace {

using engine::Error;
using engine::Result;
using Bytes = std::span<const std::byte>;

constexpr uint64_t kRunBytes = 48u << 20; // of buffers whose contents are read in one run

// Two runs of the same step on one device.
using Runs = std::array<StepCapture, 2>;

struct Side {
    ComparedWorld compared;
    Bytes state;
    const char* name;
    Runs hashes;

    template <class Capture>
    Result<Runs> twice(const Capture& capture) const {
        Runs runs;
        for (StepCapture& run : runs) {
            auto captured = capture(compared, state);
            if (!captured) return Error{captured.error().code, std::string(name) + ": " + captured.error().message};
            run = std::move(*captured);
        }
        return runs;
    }
    Result<Runs> contentsOf(const std::set<BufferId>& wanted) const {
        return twice([&](ComparedWorld world, Bytes from) { return captureContents(world, from, wanted); });
    }
    const BufferHashes& hashesOf(const BufferId& id, size_t run) const {
        return hashes[run][id.pass].written[id.buffer].hashes;
    }
    bool isRepeated(const BufferId& id) const { return hashesOf(id, 0) == hashesOf(id, 1); }
};

struct Candidate {
    BufferId a, b;
};

bool isSame(const BufferHashes& a, const BufferHashes& b) { return a.whole == b.whole || a.changes == b.changes; }

class Comparer {
public:
    Comparer(Side a, Side b) : a_(std::move(a)), b_(std::move(b)) {}

    Result<StepComparison> run() {
        for (Side* side : {&a_, &b_}) {
            auto runs = side->twice(&captureHashes);
            if (!runs) return runs.error();
            side->hashes = std::move(*runs);
        }
        findCandidates();
        for (size_t at = 0; at < candidates_.size() && found_.differing() < kMostRowsThatDiffer;) {
            auto next = addBatch(at);
            if (!next) return next.error();
            at = *next;
        }
        keepFirstRows(found_);
        return std::move(found_);
    }

private:
    void findCandidates() {
        found_.passes_a = static_cast<uint32_t>(a_.hashes[0].size());
        found_.passes_b = static_cast<uint32_t>(b_.hashes[0].size());
        const auto pairs = alignPasses(a_.hashes[0], b_.hashes[0]);
        found_.aligned = static_cast<uint32_t>(pairs.size());
        for (const auto& [pass_a, pass_b] : pairs)
            for (uint32_t k = 0; k < a_.hashes[0][pass_a].written.size(); ++k)
                addCandidate({pass_a, k}, {pass_b, k});
    }
    void addCandidate(const BufferId& a, const BufferId& b) {
        const bool is_same = isSame(a_.hashesOf(a, 0), b_.hashesOf(b, 0)) && a_.isRepeated(a) && b_.isRepeated(b);
        if (is_same) return;
        if (isUnordered(bufferOf(a_.hashes, a)))
            found_.rows.push_back(rowOf({a, b}, a_.hashes, b_.hashes, DifferenceKind::Unordered));
        else
            candidates_.push_back({a, b});
    }
    static BufferDifference rowOf(const Candidate& candidate, const Runs& runs_a, const Runs& runs_b, DifferenceKind kind) {
        const Pass &pass_a = runs_a[0][candidate.a.pass].pass, &pass_b = runs_b[0][candidate.b.pass].pass;
        const CapturedBuffer& buffer = bufferOf(runs_a, candidate.a);
        return {kind,          candidate.a.pass, candidate.b.pass, pass_a.stage,
                pass_a.kernel, pass_b.kernel,    buffer.slot,      buffer.buffer};
    }
    // Reads the contents of some candidates from `at` on, and returns where the next batch begins.
    Result<size_t> addBatch(size_t at) {
        std::set<BufferId> of_a, of_b;
        size_t end = at;
        for (uint64_t bytes = 0; end < candidates_.size() && (end == at || bytes < kRunBytes); ++end) {
            of_a.insert(candidates_[end].a);
            of_b.insert(candidates_[end].b);
            bytes += bufferOf(a_.hashes, candidates_[end].a).bytes;
        }
        const auto runs_a = a_.contentsOf(of_a), runs_b = b_.contentsOf(of_b);
        if (!runs_a) return runs_a.error();
        if (!runs_b) return runs_b.error();
        for (size_t k = at; k < end; ++k)
            addRow(candidates_[k], *runs_a, *runs_b);
        return end;
    }
    static const CapturedBuffer& bufferOf(const Runs& runs, const BufferId& id, size_t run = 0) {
        return runs[run][id.pass].written[id.buffer];
    }
    void addRow(const Candidate& candidate, const Runs& runs_a, const Runs& runs_b) {
        BufferDifference row = rowOf(candidate, runs_a, runs_b, DifferenceKind::Differs);
        const RepeatedBuffer a = {bufferOf(runs_a, candidate.a), &bufferOf(runs_a, candidate.a, 1)},
                             b = {bufferOf(runs_b, candidate.b), &bufferOf(runs_b, candidate.b, 1)};
        if (classify(a, b, row)) found_.rows.push_back(std::move(row));
    }

    Side a_, b_;
    std::vector<Candidate> candidates_;
    StepComparison found_;
};

ElementMatch matchOf(const CapturedBuffer& a, const CapturedBuffer& b) {
    return matchElements({a.before, a.after}, {b.before, b.after}, engine::elementBytes(a.fields));
}

// Elements that a device makes otherwise when it repeats the step.
std::vector<uint64_t> unstableOf(const RepeatedBuffer& buffer) {
    return buffer.second == nullptr ? std::vector<uint64_t>() : matchOf(buffer.first, *buffer.second).only_a;
}

void leaveOut(const std::vector<uint64_t>& some, std::vector<uint64_t>& elements) {
    std::erase_if(elements, [&](uint64_t element) { return std::ranges::binary_search(some, element); });
}

} // namespace

std::string_view nameOf(DifferenceKind kind) {
    constexpr std::string_view kNames[] = {"differs", "reordered", "unordered", "unstable"};
    return kNames[static_cast<size_t>(kind)];
}

const BufferDifference* StepComparison::finding() const {
    const auto found = std::ranges::find(rows, DifferenceKind::Differs, &BufferDifference::kind);
    return found == rows.end() ? nullptr : &*found;
}

size_t StepComparison::differing() const {
    return static_cast<size_t>(std::ranges::count(rows, DifferenceKind::Differs, &BufferDifference::kind));
}

void keepFirstRows(StepComparison& comparison) {
    std::ranges::stable_sort(comparison.rows, {}, &BufferDifference::pass_a);
    size_t differ = 0;
    const auto end = std::ranges::find_if(comparison.rows, [&](const BufferDifference& row) {
        return row.kind == DifferenceKind::Differs && ++differ > kMostRowsThatDiffer;
    });
    comparison.is_cut = differ >= kMostRowsThatDiffer;
    comparison.rows.erase(end, comparison.rows.end());
}

bool isUnordered(const CapturedBuffer& buffer) {
    // `polygons` name their pairs, and `adjacency` contacts, by places in a list that lanes fill.
    constexpr std::string_view kLists[] = {"found_pairs",   "long_lists", "waiting",   "listed",
                                           "contact_slots", "adjacency",  "cap_slots", "polygons"};
    const bool is_hash_table = buffer.slot.ends_with("_table");
    return is_hash_table || buffer.slot.starts_with("loose_") || buffer.slot.find("cursor") != std::string::npos ||
           std::ranges::find(kLists, buffer.slot) != std::end(kLists);
}

bool classify(const RepeatedBuffer& a, const RepeatedBuffer& b, BufferDifference& row) {
    ElementMatch match = matchOf(a.first, b.first);
    const bool is_reordered = match.moved > 0;
    const std::vector<uint64_t> unstable_a = unstableOf(a), unstable_b = unstableOf(b);
    row.written = match.written;
    row.differing = match.only_a.size();
    row.first = firstDifference(match, a.first, b.first);
    leaveOut(unstable_a, match.only_a);
    leaveOut(unstable_b, match.only_b);
    const bool differs = !match.only_a.empty() && !match.only_b.empty();
    if (differs)
        row.kind = DifferenceKind::Differs;
    else if (!unstable_a.empty() || !unstable_b.empty())
        row.kind = DifferenceKind::Unstable;
    else
        row.kind = DifferenceKind::Reordered;
    if (differs) row.first = firstDifference(match, a.first, b.first);
    return row.differing > 0 || is_reordered || !unstable_a.empty() || !unstable_b.empty();
}

engine::Result<StepComparison> compareStep(ComparedWorld a, ComparedWorld b, Bytes state_a, Bytes state_b) {
    return Comparer({a, state_a, "device A", {}}, {b, state_b, "device B", {}}).run();
}

} // namespace brittle
