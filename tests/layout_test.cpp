// Every struct that C++ and GLSL share lies alike in both: C++ offsets and sizes against those in every built kernel.
//
// A struct of a kernel that has the name of a row below must have its members, in order, at its offsets; a struct that is
// in an array must have the C++ size as its stride. A row that no kernel uses fails.
#include "engine/reflection.h"
#include "shaders-spirv/shared/body.h"
#include "shaders-spirv/shared/breaking.h"
#include "shaders-spirv/shared/collider.h"
#include "shaders-spirv/shared/contact.h"
#include "shaders-spirv/shared/debris.h"
#include "shaders-spirv/shared/drawing.h"
#include "shaders-spirv/shared/dust.h"
#include "shaders-spirv/shared/fragment_record.h"
#include "shaders-spirv/shared/hull.h"
#include "shaders-spirv/shared/impact.h"
#include "shaders-spirv/shared/material.h"
#include "shaders-spirv/shared/narrow_phase.h"
#include "shaders-spirv/shared/pool.h"
#include "shaders-spirv/shared/scene.h"
#include "shaders-spirv/shared/strike.h"
#include "tests/engine/test_device.h"

#include <cstddef>
#include <gtest/gtest.h>
#include <set>
#include <string>
#include <vector>

namespace {

struct Row {
    std::string name;
    size_t size = 0;
    std::vector<engine::ReflectedMember> members;
};

#define MEMBER(type, member)                                                                                                   \
    { #member, offsetof(gpu::type, member) }

const std::vector<Row>& rows() {
    static const std::vector<Row> kRows = {
        {"SceneVertex",
         sizeof(gpu::SceneVertex),
         {MEMBER(SceneVertex, position), MEMBER(SceneVertex, normal), MEMBER(SceneVertex, uv)}},
        {"DrawCommand",
         sizeof(gpu::DrawCommand),
         {MEMBER(DrawCommand, index_count), MEMBER(DrawCommand, instance_count), MEMBER(DrawCommand, first_index),
          MEMBER(DrawCommand, vertex_offset), MEMBER(DrawCommand, first_instance)}},
        {"ObjectMatrix", sizeof(gpu::ObjectMatrix), {MEMBER(ObjectMatrix, model)}},
        {"ObjectColor", sizeof(gpu::ObjectColor), {MEMBER(ObjectColor, outer), MEMBER(ObjectColor, inner)}},
        {"Bounds", sizeof(gpu::Bounds), {MEMBER(Bounds, lower), MEMBER(Bounds, upper)}},
        {"ObjectState",
         sizeof(gpu::ObjectState),
         {MEMBER(ObjectState, position), MEMBER(ObjectState, inverse_mass), MEMBER(ObjectState, orientation),
          MEMBER(ObjectState, velocity), MEMBER(ObjectState, radius), MEMBER(ObjectState, angular_momentum),
          MEMBER(ObjectState, fragment), MEMBER(ObjectState, inertia), MEMBER(ObjectState, material),
          MEMBER(ObjectState, flags)}},
        {"ColliderRecord",
         sizeof(brittle::ColliderRecord),
         {{"range", offsetof(brittle::ColliderRecord, range)}, {"info", offsetof(brittle::ColliderRecord, info)}}},
        {"ColliderFaceRecord",
         sizeof(brittle::ColliderFaceRecord),
         {{"plane", offsetof(brittle::ColliderFaceRecord, plane)}, {"loop", offsetof(brittle::ColliderFaceRecord, loop)}}},
        {"FragmentRecord",
         sizeof(brittle::FragmentRecord),
         {{"measure", offsetof(brittle::FragmentRecord, measure)},
          {"balance", offsetof(brittle::FragmentRecord, balance)},
          {"squares", offsetof(brittle::FragmentRecord, squares)},
          {"products", offsetof(brittle::FragmentRecord, products)},
          {"low", offsetof(brittle::FragmentRecord, low)},
          {"high", offsetof(brittle::FragmentRecord, high)},
          {"fate", offsetof(brittle::FragmentRecord, fate)},
          {"range", offsetof(brittle::FragmentRecord, range)}}},
        {"BreakingRecord",
         sizeof(gpu::BreakingRecord),
         {MEMBER(BreakingRecord, center), MEMBER(BreakingRecord, range), MEMBER(BreakingRecord, impact),
          MEMBER(BreakingRecord, low), MEMBER(BreakingRecord, high), MEMBER(BreakingRecord, sites),
          MEMBER(BreakingRecord, across), MEMBER(BreakingRecord, along)}},
        {"PoolHeader",
         sizeof(gpu::PoolHeader),
         {MEMBER(PoolHeader, capacity), MEMBER(PoolHeader, free_ranges), MEMBER(PoolHeader, in_use),
          MEMBER(PoolHeader, most_in_use), MEMBER(PoolHeader, lacked), MEMBER(PoolHeader, status),
          MEMBER(PoolHeader, returned_twice), MEMBER(PoolHeader, lost), MEMBER(PoolHeader, side)}},
        {"PoolShare", sizeof(gpu::PoolShare), {MEMBER(PoolShare, begin), MEMBER(PoolShare, size)}},
        {"BreakableBody",
         sizeof(gpu::BreakableBody),
         {MEMBER(BreakableBody, surface), MEMBER(BreakableBody, form), MEMBER(BreakableBody, low), MEMBER(BreakableBody, high),
          MEMBER(BreakableBody, balance), MEMBER(BreakableBody, turn)}},
        {"BrokenBody",
         sizeof(gpu::BrokenBody),
         {MEMBER(BrokenBody, ids), MEMBER(BrokenBody, blow), MEMBER(BrokenBody, place), MEMBER(BrokenBody, along),
          MEMBER(BrokenBody, share)}},
        {"Birth", sizeof(gpu::Birth), {MEMBER(Birth, site), MEMBER(Birth, turn), MEMBER(Birth, of)}},
        {"CrackLedger", sizeof(gpu::CrackLedger), {MEMBER(CrackLedger, outcome), MEMBER(CrackLedger, energies)}},
        {"BreakEvent",
         sizeof(gpu::BreakEvent),
         {MEMBER(BreakEvent, what), MEMBER(BreakEvent, made), MEMBER(BreakEvent, lacked), MEMBER(BreakEvent, sector),
          MEMBER(BreakEvent, offset), MEMBER(BreakEvent, along), MEMBER(BreakEvent, blow), MEMBER(BreakEvent, energies),
          MEMBER(BreakEvent, born), MEMBER(BreakEvent, sizes)}},
        {"Strike", sizeof(gpu::Strike), {MEMBER(Strike, sector), MEMBER(Strike, offset), MEMBER(Strike, energy)}},
        {"StrikeRecord",
         sizeof(gpu::StrikeRecord),
         {MEMBER(StrikeRecord, what), MEMBER(StrikeRecord, blow), MEMBER(StrikeRecord, arm), MEMBER(StrikeRecord, along)}},
        {"BodyLook", sizeof(gpu::BodyLook), {MEMBER(BodyLook, surface)}},
        {"DrawnFrom", sizeof(gpu::DrawnFrom), {MEMBER(DrawnFrom, sector), MEMBER(DrawnFrom, offset)}},
        {"DrawnBody",
         sizeof(gpu::DrawnBody),
         {MEMBER(DrawnBody, body), MEMBER(DrawnBody, step_made), MEMBER(DrawnBody, origin), MEMBER(DrawnBody, left)}},
        {"ImpactEvent",
         sizeof(gpu::ImpactEvent),
         {MEMBER(ImpactEvent, what), MEMBER(ImpactEvent, born), MEMBER(ImpactEvent, sector), MEMBER(ImpactEvent, offset),
          MEMBER(ImpactEvent, along), MEMBER(ImpactEvent, measures)}},
        {"SizeShare",
         sizeof(gpu::SizeShare),
         {MEMBER(SizeShare, dust), MEMBER(SizeShare, dust_cells), MEMBER(SizeShare, largest), MEMBER(SizeShare, smallest)}},
        {"DustParticle",
         sizeof(gpu::DustParticle),
         {MEMBER(DustParticle, sector), MEMBER(DustParticle, place), MEMBER(DustParticle, velocity),
          MEMBER(DustParticle, birth)}},
        {"DustPlane",
         sizeof(gpu::DustPlane),
         {MEMBER(DustPlane, sector), MEMBER(DustPlane, offset), MEMBER(DustPlane, normal)}},
        {"DebrisClock", sizeof(gpu::DebrisClock), {MEMBER(DebrisClock, sector), MEMBER(DebrisClock, offset)}},
        {"BodyShape", sizeof(gpu::BodyShape), {MEMBER(BodyShape, pieces), MEMBER(BodyShape, inverse_inertia)}},
        {"MaterialCard", sizeof(gpu::MaterialCard), {MEMBER(MaterialCard, elastic), MEMBER(MaterialCard, cracks)}},
        {"HullRecord",
         sizeof(gpu::HullRecord),
         {MEMBER(HullRecord, first), MEMBER(HullRecord, count), MEMBER(HullRecord, center)}},
        {"HullFace", sizeof(gpu::HullFace), {MEMBER(HullFace, plane), MEMBER(HullFace, loop)}},
        {"BodyState",
         sizeof(gpu::BodyState),
         {MEMBER(BodyState, sector), MEMBER(BodyState, offset), MEMBER(BodyState, turn), MEMBER(BodyState, velocity),
          MEMBER(BodyState, spin), MEMBER(BodyState, momentum)}},
        {"PieceRecord", sizeof(gpu::PieceRecord), {MEMBER(PieceRecord, ids)}},
        {"ContactPoint",
         sizeof(gpu::ContactPoint),
         {MEMBER(ContactPoint, arm_a), MEMBER(ContactPoint, arm_b), MEMBER(ContactPoint, id)}},
        {"Manifold",
         sizeof(gpu::Manifold),
         {MEMBER(Manifold, pair), MEMBER(Manifold, normal), MEMBER(Manifold, info), MEMBER(Manifold, points)}},
        {"AxisRecord",
         sizeof(gpu::AxisRecord),
         {MEMBER(AxisRecord, axis), MEMBER(AxisRecord, shift), MEMBER(AxisRecord, info)}},
        {"DrawPush",
         sizeof(gpu::DrawPush),
         {MEMBER(DrawPush, view_projection), MEMBER(DrawPush, eye), MEMBER(DrawPush, key_direction),
          MEMBER(DrawPush, outer_color), MEMBER(DrawPush, inner_color)}},
    };
    return kRows;
}

// What differs between a kernel's struct and the row; empty if nothing does.
std::string difference(const Row& row, const engine::ReflectedStruct& found) {
    if (found.members.size() != row.members.size()) return "has " + std::to_string(found.members.size()) + " members";
    for (size_t m = 0; m < row.members.size(); ++m) {
        const auto& ours = row.members[m];
        const auto& theirs = found.members[m];
        if (ours.name != theirs.name) return "has " + theirs.name + " where C++ has " + ours.name;
        if (ours.offset == theirs.offset) continue;
        return theirs.name + " is at " + std::to_string(theirs.offset) + ", in C++ at " + std::to_string(ours.offset);
    }
    if (found.array_stride == 0 || found.array_stride == row.size) return "";
    return "has a stride of " + std::to_string(found.array_stride) + ", in C++ of " + std::to_string(row.size);
}

// Names of the rows that were met.
std::set<std::string> compare(const shaders::Module& module) {
    std::set<std::string> met;
    const auto reflection = engine::reflect(module.words);
    EXPECT_TRUE(reflection) << module.name;
    if (!reflection) return met;
    for (const engine::ReflectedStruct& found : reflection->structs) {
        for (const Row& row : rows()) {
            if (found.name != row.name) continue;
            met.insert(row.name);
            const std::string differs = difference(row, found);
            EXPECT_TRUE(differs.empty()) << module.name << ": " << row.name << " " << differs;
        }
    }
    return met;
}

} // namespace

TEST(Layout, OfSharedStructsIsTheSameInEveryKernel) {
    std::set<std::string> met;
    for (const auto modules : {shaders::all(), shaders::engineTestKernels()}) {
        for (const shaders::Module& module : modules)
            met.merge(compare(module));
    }
    for (const Row& row : rows())
        EXPECT_TRUE(met.contains(row.name)) << row.name << " is in no kernel";
}

TEST(Layout, DifferencesAreFound) {
    const Row row{"Pair", 12, {{"first", 0}, {"second", 4}}};
    EXPECT_EQ(difference(row, {"Pair", {{"first", 0}, {"second", 4}}, 12}), "");
    EXPECT_EQ(difference(row, {"Pair", {{"first", 0}, {"second", 4}}, 0}), "");
    EXPECT_NE(difference(row, {"Pair", {{"first", 0}, {"second", 8}}, 12}), "");
    EXPECT_NE(difference(row, {"Pair", {{"first", 0}, {"other", 4}}, 12}), "");
    EXPECT_NE(difference(row, {"Pair", {{"first", 0}}, 12}), "");
    EXPECT_NE(difference(row, {"Pair", {{"first", 0}, {"second", 4}}, 16}), "");
}
