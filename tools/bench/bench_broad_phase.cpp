// The broad phase on its own, next to Bullet's dynamic trees: pairs of boxes that meet.
#include "modules/brittle/dynamics/broad_phase.h"
#include "modules/brittle/fracture/fetch.h"
#include "modules/brittle/fracture/upload.h"
#include "modules/brittle/mesh/vector_math.h"
#include "tools/bench/peer_bullet.h"
#include "tools/bench/phase_run.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace bench {
namespace {

using brittle::Double3;
using brittle::operator+, brittle::operator-, brittle::operator*;
using engine::Buffer;
using engine::Result;

constexpr double kRoom = 0.42;               // m3 for each box
constexpr double kLeast = 0.6, kMost = 1.04; // m, their edges
constexpr double kStep = 0.03;               // m, the most that one moves by along an axis from run to run
constexpr uint32_t kPairsPerBox = 16;        // room for them

std::vector<BoxOfSpace> heapOf(uint32_t count, uint64_t seed) {
    Dice dice(seed);
    const double half_edge = std::cbrt(kRoom * count) / 2;
    std::vector<BoxOfSpace> boxes;
    for (uint32_t k = 0; k < count; ++k) {
        const Double3 center = dice.inBox(half_edge);
        Double3 half = {0, 0, 0};
        for (double& h : half)
            h = dice.between(kLeast, kMost) / 2;
        boxes.push_back({center - half, center + half});
    }
    return boxes;
}

// Each goes on its own way, as long as all others.
std::vector<BoxOfSpace> moved(const std::vector<BoxOfSpace>& boxes, uint64_t seed, uint32_t rounds) {
    Dice dice(seed);
    std::vector<BoxOfSpace> now = boxes;
    for (BoxOfSpace& box : now) {
        const Double3 way = static_cast<double>(rounds) * dice.inBox(kStep);
        box = {box.low + way, box.high + way};
    }
    return now;
}

// The broad phase with its pools, for one number of boxes.
class OurBoxes {
public:
    OurBoxes(engine::Device& device, uint32_t boxes, uint32_t lanes)
        : device_(device),
          kernels_(device, shaders::all(), {{FLAT_SIZE_ID, lanes}}), budget_{boxes, kPairsPerBox * boxes,
                                                                             brittle::chosenSort(boxes, device.isCpu())} {}

    Result<void> prepare() {
        auto arena = engine::ScratchArena::create(device_, std::max<uint64_t>(brittle::broadPhaseBytes(budget_), 256), "boxes");
        if (!arena) return arena.error();
        arena_ = std::make_unique<engine::ScratchArena>(std::move(*arena));
        auto scratch = brittle::layOutBroadPhase(*arena_, budget_);
        if (!scratch) return scratch.error();
        scratch_ = *scratch;
        Buffers buffers(device_);
        low_ = buffers.make(16ull * budget_.boxes, "box low");
        high_ = buffers.make(16ull * budget_.boxes, "box high");
        pairs_ = buffers.make(8ull * budget_.pairs, "pairs");
        counts_ = buffers.make(4 * STATUS_WORDS, "counts");
        args_ = buffers.make(36 * COUNT_TOTAL, "arguments");
        return buffers.status();
    }

    // Milliseconds of device time.
    Result<double> find(const std::vector<BoxOfSpace>& boxes) {
        if (auto done = upload(boxes); !done) return done.error();
        engine::Commands commands(device_);
        if (auto begun = commands.begin(); !begun) return begun.error();
        brittle::Recorder record(commands, kernels_, counts_, args_);
        record.clear({engine::BufferView(counts_)});
        commands.fill(engine::BufferView(counts_).sub(4 * COUNT_BOXES, 4), budget_.boxes);
        brittle::recordBroadPhase(record, {budget_, scratch_, low_, high_, pairs_});
        if (auto recorded = record.status(); !recorded) return recorded.error();
        if (auto done = commands.submitAndWait(); !done) return done.error();
        return labelMs(commands, "broad_phase");
    }

    Result<size_t> pairCount() {
        std::vector<uint32_t> words(STATUS_WORDS);
        const brittle::Fetch wanted[] = {{counts_, words.data(), 4 * words.size()}};
        if (auto read = brittle::fetch(device_, wanted); !read) return read.error();
        if (words[STATUS_FAILED] != 0)
            return engine::Error{engine::ErrorCode::Capacity, "the broad phase of " + std::to_string(budget_.boxes) +
                                                                  " boxes finds more than " + std::to_string(budget_.pairs) +
                                                                  " pairs; ask for fewer boxes"};
        return words[COUNT_BOX_PAIRS];
    }

private:
    Result<void> upload(const std::vector<BoxOfSpace>& boxes) {
        std::vector<gpu::vec4> low, high;
        for (uint32_t k = 0; k < boxes.size(); ++k) {
            low.push_back(wordsOf(boxes[k].low, std::bit_cast<float>(k)));
            high.push_back(wordsOf(boxes[k].high, 0));
        }
        brittle::Upload both;
        both.add(std::span<const gpu::vec4>(low), low_);
        both.add(std::span<const gpu::vec4>(high), high_);
        return both.send(device_);
    }

    engine::Device& device_;
    engine::KernelLibrary kernels_;
    brittle::BroadPhaseBudget budget_;
    std::unique_ptr<engine::ScratchArena> arena_;
    brittle::BroadPhaseScratch scratch_;
    Buffer low_, high_, pairs_, counts_, args_;
};

struct PhaseSamples {
    std::vector<double> ours, built, moved; // milliseconds
};

Result<void> runOnce(OurBoxes& ours, BulletBoxes* kept, const std::vector<BoxOfSpace>& boxes, PhaseSamples& samples) {
    const auto took = ours.find(boxes);
    if (!took) return took.error();
    samples.ours.push_back(*took);
    if (kept == nullptr) return {};
    samples.moved.push_back(kept->move(boxes));
    samples.built.push_back(BulletBoxes::create()->build(boxes));
    return {};
}

Result<BroadPhaseRow> benchBoxes(engine::Device& device, uint32_t count, const BenchOptions& options) {
    const std::vector<BoxOfSpace> heap = heapOf(count, options.seed);
    OurBoxes ours(device, count, lanesOf(options));
    if (auto prepared = ours.prepare(); !prepared) return prepared.error();
    const auto kept = options.peers ? BulletBoxes::create() : nullptr;
    if (kept) kept->build(heap);
    PhaseSamples warm_up, samples;
    for (uint32_t round = 0; round <= options.rounds; ++round) {
        const std::vector<BoxOfSpace> boxes = moved(heap, options.seed + 1, round + 1);
        if (auto done = runOnce(ours, kept.get(), boxes, round == 0 ? warm_up : samples); !done) return done.error();
    }
    const auto pairs = ours.pairCount();
    if (!pairs) return pairs.error();
    return BroadPhaseRow{
        count, *pairs, median(samples.ours), kept ? kept->pairCount() : 0, median(samples.built), median(samples.moved)};
}

} // namespace

Result<std::vector<BroadPhaseRow>> benchBroadPhase(engine::Device& device, const BenchOptions& options,
                                                   const Progress& progress) {
    std::vector<BroadPhaseRow> rows;
    for (const uint32_t count : options.box_counts) {
        progress("broad phase of " + std::to_string(count) + " boxes");
        const auto row = benchBoxes(device, count, options);
        if (!row) return row.error();
        rows.push_back(*row);
    }
    return rows;
}

} // namespace bench
