// Hard breaks at exact precision, meshes that bound no solid, and worlds whose pools are full: each fulfills what it has to.
#include "tests/engine/test_device.h"
#include "tests/hard/hard_fractures.h"
#include "tests/hard/hard_meshes.h"
#include "tests/hard/hard_worlds.h"
#include "tests/module/whole_fracture.h"

#include <gtest/gtest.h>

#include <cctype>

namespace {

using hard::Check, hard::Trial;

void expectHolds(const Trial& trial) {
    ASSERT_FALSE(trial.failure()) << *trial.failure();
    EXPECT_FALSE(trial.checks().empty());
    for (const Check& check : trial.checks())
        EXPECT_LE(check.value, check.allowed) << check.what << ", " << check.unit;
}

std::string testName(std::string name) {
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return name;
}

class HardFractures : public testing::TestWithParam<hard::FractureCase> {};

TEST_P(HardFractures, KeepTheContract) {
    Trial trial(engine_test::device());
    hard::measureFracture(trial, whole::fracture(), GetParam(), brittle::Precision::Exact);
    expectHolds(trial);
}

INSTANTIATE_TEST_SUITE_P(Quick, HardFractures, testing::ValuesIn(hard::fractureCases()),
                         [](const auto& one) { return testName(one.param.name); });

TEST(HardMeshes, AreRefusedWithWordsThatSayWhy) {
    for (const hard::MeshCase& mesh : hard::meshCases()) {
        SCOPED_TRACE(mesh.name);
        Trial trial(engine_test::device());
        hard::measureMesh(trial, mesh);
        expectHolds(trial);
    }
}

TEST(HardPools, WhatThereIsNoRoomForStaysWholeSaysWhyAndIsStoppedAsAnyBody) {
    for (const hard::PoolCase& pool : hard::poolCases()) {
        SCOPED_TRACE(pool.name);
        Trial trial(engine_test::device());
        hard::measurePool(trial, pool);
        expectHolds(trial);
    }
}

} // namespace
