#include "engine/buffer_values.h"
#include "tests/engine/test_device.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

using namespace engine;

namespace {

// "points[].at": 12 bytes of floats, then "points[].name", 16 bytes in all.
std::vector<ReflectedField> fieldsOfPoints() {
    ReflectedField at = {"points[].at", "Point", "", "float", 3, 1, 0, 0, {{0, 16, 0}}};
    ReflectedField name = {"points[].name", "Point", "", "uint", 1, 1, 0, 12, {{0, 16, 0}}};
    return {at, name};
}

template <class T>
std::string textOf(const std::string& scalar, T value) {
    std::byte bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    return valueText(scalar, bytes);
}

} // namespace

TEST(BufferValues, NamesTheMemberOfAnElement) {
    const auto place = numberAt(fieldsOfPoints(), 16 * 5 + 8);
    ASSERT_TRUE(place);
    EXPECT_EQ(place->path, "points[5].at.z");
    EXPECT_EQ(place->scalar, "float");
    EXPECT_EQ(place->byte, 88u);
    EXPECT_EQ(numberAt(fieldsOfPoints(), 12)->path, "points[0].name");
}

TEST(BufferValues, NamesNestedArraysAndMatrices) {
    const ReflectedField corner = {"hulls[].corners[].at", "Corner", "", "float", 2, 1, 0, 0, {{8, 8, 4}, {0, 64, 0}}};
    EXPECT_EQ(numberAt({{corner}}, 64 * 3 + 8 + 8 * 2 + 4)->path, "hulls[3].corners[2].at.y");
    EXPECT_FALSE(numberAt({{corner}}, 4));             // before the inner array
    EXPECT_FALSE(numberAt({{corner}}, 8 + 8 * 4 + 4)); // behind it
    const ReflectedField matrix = {"m[].model", "M", "", "float", 3, 4, 16, 0, {{0, 64, 0}}};
    EXPECT_EQ(numberAt({{matrix}}, 64 + 32 + 4)->path, "m[1].model[2].y");
    EXPECT_FALSE(numberAt({{matrix}}, 12)); // padding of the first column
}

TEST(BufferValues, TellsTheSizeOfAnElement) {
    EXPECT_EQ(elementBytes(fieldsOfPoints()), 16u);
    EXPECT_EQ(elementBytes({}), 4u);
    const ReflectedField count = {"count", "Block", "", "uint", 1, 1, 0, 0, {}};
    EXPECT_EQ(elementBytes({{count}}), 4u);
}

TEST(BufferValues, ShowsNumbersWithAllTheirDigits) {
    EXPECT_EQ(textOf("float", 0.1f), "0.1");
    EXPECT_EQ(textOf("float", std::nextafter(0.1f, 1.0f)), "0.10000001");
    EXPECT_EQ(textOf("double", 0.1), "0.1");
    EXPECT_EQ(textOf("int", -3), "-3");
    EXPECT_EQ(textOf("uint", 4000000000u), "4000000000");
    EXPECT_EQ(textOf("bits", 0x3dccccdu), "0x03dccccd");
}

TEST(BufferValues, ReadsTheLayoutOfAKernel) {
    for (const shaders::Module& module : shaders::engineTestKernels()) {
        if (module.name != "reflected") continue;
        const auto reflection = reflect(module.words);
        ASSERT_TRUE(reflection);
        EXPECT_EQ(numberAt(reflection->bindings[2].fields, 64 + 20)->path, "matrices[1].model[1].y");
        EXPECT_EQ(elementBytes(reflection->bindings[2].fields), 64u);
        EXPECT_EQ(numberAt(reflection->bindings[3].fields, 4 + 4 * 7)->path, "rest[7]");
        EXPECT_EQ(elementBytes(reflection->bindings[3].fields), 4u); // a word comes before the list
    }
}
