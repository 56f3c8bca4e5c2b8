// Named spans of device time within one recording.
#pragma once

#include "engine/vulkan.h"

#include <string>
#include <vector>

namespace engine {

class Device;
struct Queue;

struct Timing {
    std::string name;
    double ms = 0;      // added up over all spans of this name
    uint32_t count = 0; // how many spans
};

class Timestamps {
public:
    Timestamps(Device& device, const Queue& queue) : device_(device), queue_(queue) {}
    ~Timestamps();
    Timestamps(const Timestamps&) = delete;
    Timestamps& operator=(const Timestamps&) = delete;

    Result<void> begin(VkCommandBuffer commands, std::string_view name);
    void end(VkCommandBuffer commands);
    bool open() const { return open_; }
    void reset();

    // In the order of first appearance; after the device has finished. Empty on a queue without timestamps.
    Result<std::vector<Timing>> read() const;
    // The same span by span, in ms.
    Result<std::vector<double>> spans() const;

private:
    void write(VkCommandBuffer commands, uint32_t query) const;
    double milliseconds(uint64_t begin, uint64_t end) const;

    Device& device_;
    const Queue& queue_;
    std::vector<VkQueryPool> pools_;
    std::vector<std::string> names_; // span i has the queries 2 i and 2 i + 1
    bool open_ = false;
};

} // namespace engine
