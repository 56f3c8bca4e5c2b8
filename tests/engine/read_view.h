// What a buffer of the test device holds.
#pragma once

#include "engine/commands.h"
#include "tests/engine/test_device.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

namespace engine_test {

template <class T>
std::vector<T> valuesOf(const engine::BufferView& view) {
    const size_t words = view.size / 4;
    engine::Buffer target = readback(device(), words);
    engine::Commands commands(device());
    EXPECT_TRUE(commands.begin());
    commands.copy(view, target);
    finish(commands);
    std::vector<T> values(view.size / sizeof(T));
    std::memcpy(static_cast<void*>(values.data()), target.mappedAs<uint32_t>(), values.size() * sizeof(T));
    return values;
}

} // namespace engine_test
