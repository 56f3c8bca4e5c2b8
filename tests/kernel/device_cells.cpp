#include "tests/kernel/device_cells.h"

#include "modules/brittle/fracture/deciding_kernels.h"
#include "tests/kernel/device_tree.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace kernel_test {
namespace {

using reference::SiteSet;

// The exact kernels, small to large: what one cannot hold is queued for the next.
struct SizeClass {
    const char* kernel;
    uint32_t planes, corners, room; // room: cells that it may have to do
    bool wide;                      // a corner is two words instead of one
    uint32_t words() const { return 2 + planes + (wide ? 2 : 1) * corners; }
};
constexpr uint32_t kStoreWords = 28; // per corner, planes among them, where a kernel keeps its cell in a buffer

std::array<SizeClass, 3> sizeClasses(uint32_t sites) {
    return {SizeClass{"cut_cells_exact", RAW_PLANES, RAW_CORNERS, sites, false},
            SizeClass{"cut_cells_exact_medium", 256, 512, std::min(sites, 1100u), true},
            SizeClass{"cut_cells_exact_large", 2048, 4096, 4, true}};
}

struct WordCounts {
    uint32_t queue = 1, raw = 0, store = 1;
};

WordCounts wordCounts(uint32_t sites) {
    WordCounts words;
    for (const SizeClass& size : sizeClasses(sites)) {
        words.queue += size.room;
        words.raw += size.room * size.words();
        if (size.wide) words.store = std::max(words.store, size.room * size.corners * kStoreWords);
    }
    return words;
}

struct CutPush {
    Int4 bins, box_low, box_high;
    uint32_t cell_count, size_class, raw_base, next_capacity;
};

struct FilterPush {
    Int4 bins, box_low, box_high;
    uint32_t turn_budget;
};

struct EdgesPush {
    Int4 bins, box_low, box_high;
};

// Queues and raw cells of the classes lie one after the other.
CutPush cutPush(const SiteSet& set, const BinnedSites& binned, uint32_t size_class, Path path) {
    const uint32_t n = static_cast<uint32_t>(set.sites.size());
    const auto classes = sizeClasses(n);
    uint32_t queue = 0, raw = 0;
    for (uint32_t k = 0; k < size_class; ++k) {
        queue += classes[k].room;
        raw += classes[k].room * classes[k].words();
    }
    const auto corner = [](const reference::GridPoint& p, uint32_t w) {
        return Int4{p[0], p[1], p[2], static_cast<int32_t>(w)};
    };
    return {binned.bins,
            corner(set.box.lower, queue),
            corner(set.box.upper, queue + classes[size_class].room),
            size_class == 0 && path == Path::Exact ? n : NO_INDEX,
            size_class,
            raw,
            size_class < 2 ? classes[size_class + 1].room : 0};
}

// A cell as the kernels leave it: status, counts, the planes' ids, then corners as triples of plane indices.
struct RawCell {
    const uint32_t* words;
    const SizeClass& size;
    uint32_t planeCount() const { return words[1] & 0xffff; }
    uint32_t cornerCount() const { return words[1] >> 16; }
    std::array<uint32_t, 3> corner(uint32_t t) const {
        const uint32_t* first = words + 2 + size.planes + (size.wide ? 2 * t : t);
        if (size.wide) return {first[0] & 0xffff, first[0] >> 16, first[1]};
        return {*first & 0xff, *first >> 8 & 0xff, *first >> 16};
    }
};

reference::VoronoiCell decode(uint32_t site, const RawCell& raw, uint32_t site_count) {
    const auto idOf = [&](uint32_t plane) {
        const uint32_t id = raw.words[2 + plane];
        return id >= BOX_BASE ? site_count + id - BOX_BASE : id;
    };
    reference::VoronoiCell cell;
    cell.site = site;
    for (uint32_t t = 0; t < raw.cornerCount(); ++t) {
        const auto [a, b, c] = raw.corner(t);
        reference::VertexName name = {site, idOf(a), idOf(b), idOf(c)};
        std::sort(name.begin(), name.end());
        cell.vertices.push_back(name);
        // A plane that was cut away again has no corner left.
        for (const uint32_t plane : {a, b, c})
            cell.neighbors.push_back(idOf(plane));
    }
    std::sort(cell.vertices.begin(), cell.vertices.end());
    std::sort(cell.neighbors.begin(), cell.neighbors.end());
    cell.neighbors.erase(std::unique(cell.neighbors.begin(), cell.neighbors.end()), cell.neighbors.end());
    return cell;
}

// Cubic bins, as small as they can be with two sites to each of them.
Int4 binsFor(const SiteSet& set) {
    const double wanted = std::max(1.0, static_cast<double>(set.sites.size()) / 2);
    for (double edge = 1;; edge = std::ceil(edge * 1.02)) {
        Int4 bins = {0, 0, 0, static_cast<int32_t>(edge)};
        double total = 1;
        for (size_t k = 0; k < 3; ++k) {
            bins[k] = (set.box.upper[k] - set.box.lower[k]) / bins[3] + 1;
            total *= bins[k];
        }
        if (total <= wanted) return bins;
    }
}

} // namespace

BinnedSites binSites(const SiteSet& set) {
    BinnedSites binned;
    binned.bins = binsFor(set);
    const auto binOf = [&](const reference::GridPoint& p) {
        size_t bin = 0;
        for (size_t k = 3; k-- > 0;)
            bin = bin * static_cast<size_t>(binned.bins[k]) + static_cast<size_t>((p[k] - set.box.lower[k]) / binned.bins[3]);
        return bin;
    };
    std::vector<std::vector<Int4>> bins(static_cast<size_t>(binned.bins[0]) * static_cast<size_t>(binned.bins[1]) *
                                        static_cast<size_t>(binned.bins[2]));
    for (size_t s = 0; s < set.sites.size(); ++s) {
        const reference::GridPoint& p = set.sites[s];
        binned.sites.push_back({p[0], p[1], p[2], 0});
        bins[binOf(p)].push_back({p[0], p[1], p[2], static_cast<int32_t>(s)});
    }
    for (const std::vector<Int4>& bin : bins) {
        binned.bin_start.push_back(static_cast<uint32_t>(binned.bin_sites.size()));
        binned.bin_sites.insert(binned.bin_sites.end(), bin.begin(), bin.end());
    }
    binned.bin_start.push_back(static_cast<uint32_t>(binned.bin_sites.size()));
    return binned;
}

RawCells cutRaw(const SiteSet& set, Path path, brittle::Precision precision) {
    const uint32_t n = static_cast<uint32_t>(set.sites.size());
    const BinnedSites binned = binSites(set);
    const WordCounts words = wordCounts(n);
    Counts counts;
    counts[COUNT_SITES] = n;
    RawCells result{blankBuffer<uint32_t>(words.raw), blankBuffer<Word2>(n)};
    const engine::Buffer sites = bufferOf(binned.sites), bin_start = bufferOf(binned.bin_start);
    const engine::Buffer bin_sites = bufferOf(binned.bin_sites), queue = blankBuffer<uint32_t>(words.queue);
    const engine::Buffer store = blankBuffer<uint32_t>(words.store);
    const auto cutter = [&](const char* name) -> const engine::Kernel& {
        const auto found = brittle::kernelFor(kernels(), name, 0, precision);
        ENGINE_ASSERT(found.has_value());
        return **found;
    };
    std::optional<DeviceTree> tree;
    if (path == Path::FilteredTree) tree = growTree(binned.bin_sites, 12);
    const auto filter = [&](engine::Commands& commands) {
        const auto& [low, high] = set.box;
        const FilterPush push = {binned.bins, {low[0], low[1], low[2], 0}, {high[0], high[1], high[2], 0}, 7500};
        if (path == Path::FilteredEdges)
            commands.dispatchGroups(cutter("cut_cells_edges"), n, EdgesPush{push.bins, push.box_low, push.box_high},
                                    {counts.words, sites, bin_start, bin_sites, result.raw, result.at, queue, counts.args});
        else if (path == Path::FilteredLinear)
            commands.dispatch(cutter("cut_cells_linear"), n, push,
                              {counts.words, bin_sites, result.raw, result.at, queue, counts.args});
        else if (tree)
            commands.dispatch(cutter("cut_cells_tree"), n, push,
                              {counts.words, bin_sites, result.raw, result.at, queue, counts.args, tree->nodes,
                               tree->leaf_start, tree->leaf_sites});
        else
            commands.dispatch(cutter("cut_cells"), n, push,
                              {counts.words, bin_sites, result.raw, result.at, queue, counts.args, bin_start});
    };
    const auto exact = [&](engine::Commands& commands, uint32_t k, const SizeClass& size) {
        const CutPush push = cutPush(set, binned, k, path);
        const std::initializer_list<engine::BufferView> buffers = {counts.words, sites,      bin_start, bin_sites,
                                                                   queue,        result.raw, result.at, store};
        if (k > 0) counts.publish(commands, COUNT_EXACT_SMALL + k, size.room);
        if (push.cell_count != NO_INDEX)
            commands.dispatchGroups(cutter(size.kernel), n, push, buffers);
        else
            commands.dispatchIndirect(cutter(size.kernel), counts.groupsOf(COUNT_EXACT_SMALL + k), push, buffers);
    };
    onDevice([&](engine::Commands& commands) {
        if (path != Path::Exact) filter(commands);
        uint32_t k = 0;
        for (const SizeClass& size : sizeClasses(n))
            exact(commands, k++, size);
    });
    result.undecided = counts[COUNT_EXACT_SMALL];
    result.redone = counts[COUNT_EXACT_MEDIUM];
    return result;
}

DeviceCells cutOnDevice(const SiteSet& set, Path path, brittle::Precision precision) {
    const uint32_t n = static_cast<uint32_t>(set.sites.size());
    const auto classes = sizeClasses(n);
    const RawCells raw = cutRaw(set, path, precision);
    DeviceCells result;
    result.undecided = raw.undecided;
    result.redone = raw.redone;
    for (uint32_t s = 0; s < n; ++s) {
        const Word2 place = raw.at.mappedAs<Word2>()[s];
        const RawCell cell{raw.raw.mappedAs<uint32_t>() + place[0], classes[place[1]]};
        if (cell.words[0] != CELL_OK) ++result.unfinished;
        result.cells.push_back(decode(s, cell, n));
    }
    return result;
}

} // namespace kernel_test
