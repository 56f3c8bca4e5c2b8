// Runs single kernels on buffers that the host can fill and look into.
#pragma once

#include "engine/commands.h"
#include "shaders-spirv/shared/fracture.h"
#include "tests/engine/test_device.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <string>
#include <vector>

namespace shaders {
std::span<const Module> kernelTestKernels(); // over single functions of shaders-spirv/lib
}

namespace kernel_test {

using Word2 = std::array<uint32_t, 2>;
using Word4 = std::array<uint32_t, 4>;
using Int4 = std::array<int32_t, 4>;

engine::KernelLibrary& kernels(); // of the project
const engine::Kernel& kernel(std::string_view name, std::initializer_list<uint32_t> spec = {});
const engine::Kernel& testKernel(std::string_view name);

// Holds the values; never empty, because an empty buffer cannot be bound.
template <class T>
engine::Buffer bufferOf(const std::vector<T>& values, size_t at_least = 1) {
    const size_t size = std::max(values.size(), at_least) * sizeof(T);
    auto buffer = engine::Buffer::create(engine_test::device(), size, engine::BufferDomain::Readback, 0, "test");
    ENGINE_ASSERT(buffer.has_value());
    std::memset(buffer->mapped(), 0, size);
    if (!values.empty()) std::memcpy(buffer->mapped(), values.data(), values.size() * sizeof(T));
    return std::move(*buffer);
}

// Filled with a pattern that no kernel writes by chance.
template <class T>
engine::Buffer blankBuffer(size_t count) {
    engine::Buffer buffer = bufferOf(std::vector<T>(count));
    std::memset(buffer.mapped(), 0xcd, buffer.size());
    return buffer;
}

template <class T>
std::vector<T> valuesOf(const engine::Buffer& buffer, size_t count) {
    ENGINE_ASSERT(count * sizeof(T) <= buffer.size());
    const T* values = buffer.mappedAs<T>();
    return {values, values + count};
}

inline std::vector<uint32_t> countUp(size_t count) {
    std::vector<uint32_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0u);
    return numbers;
}

// Records what `record` adds, submits it and waits. A mistake in that ends the program: what follows would read garbage.
template <class Record>
void onDevice(Record&& record) {
    engine::Commands commands(engine_test::device());
    const auto begun = commands.begin();
    if (begun) record(commands);
    const auto done = begun ? commands.submitAndWait() : begun;
    if (done) return;
    std::fprintf(stderr, "%s\n", done.error().message.c_str());
    std::_Exit(EXIT_FAILURE);
}

// The words that every fracture kernel reads first: counts, and what went wrong.
struct Counts {
    engine::Buffer words = bufferOf(std::vector<uint32_t>(STATUS_WORDS));
    engine::Buffer args = bufferOf(std::vector<uint32_t>(9 * COUNT_TOTAL));
    uint32_t& operator[](uint32_t index) { return words.mappedAs<uint32_t>()[index]; }
    // Makes a count known to dispatches: a lane for each of it, or a workgroup for each.
    void publish(engine::Commands& commands, uint32_t index, uint32_t room) const;
    engine::BufferView lanesOf(uint32_t index) const { return engine::BufferView(args).sub(36 * index, 12); }
    engine::BufferView groupsOf(uint32_t index) const { return engine::BufferView(args).sub(36 * index + 24, 12); }
    // What was published for the kernels over a count: grids of lanes in workgroups, of scan blocks, and of single workgroups.
    std::vector<uint32_t> argsOf(uint32_t index) const {
        const uint32_t* first = args.mappedAs<uint32_t>() + 9 * index;
        return {first, first + 9};
    }
};

// offsets[k] = values[0] + ... + values[k - 1], one more than values; four channels: values are Word4. The totals become the
// published counts.
void scan(engine::Commands& commands, const Counts& counts, uint32_t length, const engine::Buffer& values,
          const engine::Buffer& sums, const engine::Buffer& offsets, bool four_channels, const Word4& published);

constexpr uint32_t kSizes[] = {1, 63, 64, 65, 1234};

} // namespace kernel_test
