#include "engine/timestamps.h"

#include "engine/device.h"

#include <algorithm>

namespace engine {

namespace {

constexpr uint32_t kQueriesPerPool = 512;

} // namespace

Timestamps::~Timestamps() {
    for (VkQueryPool pool : pools_)
        device_.vk().vkDestroyQueryPool(device_.handle(), pool, nullptr);
}

Result<void> Timestamps::begin(VkCommandBuffer commands, std::string_view name) {
    ENGINE_ASSERT(!open_);
    if (queue_.timestamp_bits == 0) return {};
    const auto query = static_cast<uint32_t>(2 * names_.size());
    if (query / kQueriesPerPool == pools_.size()) {
        VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
        info.queryType = VK_QUERY_TYPE_TIMESTAMP;
        info.queryCount = kQueriesPerPool;
        VkQueryPool pool = VK_NULL_HANDLE;
        const VkResult made = device_.vk().vkCreateQueryPool(device_.handle(), &info, nullptr, &pool);
        if (made != VK_SUCCESS) return vulkanError("query pool", made);
        pools_.push_back(pool);
    }
    if (query % kQueriesPerPool == 0) {
        device_.vk().vkCmdResetQueryPool(commands, pools_[query / kQueriesPerPool], 0, kQueriesPerPool);
    }
    names_.emplace_back(name);
    write(commands, query);
    open_ = true;
    return {};
}

void Timestamps::end(VkCommandBuffer commands) {
    if (!open_) return;
    write(commands, static_cast<uint32_t>(2 * names_.size() - 1));
    open_ = false;
}

void Timestamps::reset() {
    names_.clear();
    open_ = false;
}

Result<std::vector<Timing>> Timestamps::read() const {
    const auto ms = spans();
    if (!ms) return ms.error();
    std::vector<Timing> timings;
    for (size_t span = 0; span < names_.size(); ++span) {
        auto place = std::ranges::find(timings, names_[span], &Timing::name);
        if (place == timings.end()) place = timings.insert(timings.end(), {names_[span], 0, 0});
        place->ms += (*ms)[span];
        ++place->count;
    }
    return timings;
}

Result<std::vector<double>> Timestamps::spans() const {
    std::vector<double> ms;
    for (size_t span = 0; span < names_.size(); ++span) {
        const auto query = static_cast<uint32_t>(2 * span);
        uint64_t ticks[2] = {};
        const VkResult got = device_.vk().vkGetQueryPoolResults(
            device_.handle(), pools_[query / kQueriesPerPool], query % kQueriesPerPool, 2, sizeof(ticks), ticks,
            sizeof(ticks[0]), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
        if (got != VK_SUCCESS) return vulkanError("timestamps", got);
        ms.push_back(milliseconds(ticks[0], ticks[1]));
    }
    return ms;
}

// Bottom of the pipe for both ends: a span begins when all before it has ended.
void Timestamps::write(VkCommandBuffer commands, uint32_t query) const {
    device_.vk().vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pools_[query / kQueriesPerPool],
                                     query % kQueriesPerPool);
}

double Timestamps::milliseconds(uint64_t begin, uint64_t end) const {
    const uint64_t mask = queue_.timestamp_bits >= 64 ? ~0ull : (1ull << queue_.timestamp_bits) - 1;
    return static_cast<double>((end - begin) & mask) * double(device_.limits().timestampPeriod) * 1e-6;
}

} // namespace engine
