// A model file as some program writes it, and what becomes of it.
#pragma once

#include "modules/brittle/mesh/check.h"
#include "modules/brittle/mesh/import.h"
#include "modules/brittle/mesh/prepare.h"

#include <gtest/gtest.h>

#include <ostream>

struct Variant {
    const char* name;
    const char* ending;
    std::string bytes;
    const char* refusal = ""; // part of it; "" if the file is a tetrahedron
    const char* note = "";    // part of the only note; "" if no note is expected
};

inline void PrintTo(const Variant& variant, std::ostream* out) { *out << variant.name; }

// Reads the file and checks the mesh, as breaking it would.
inline std::string refusalOf(const Variant& file, std::vector<std::string>& notes) {
    const auto imported = brittle::importMesh(file.bytes, file.ending);
    if (!imported) return imported.error().message;
    notes = imported->notes;
    const auto model = brittle::prepareMesh(*imported);
    if (!model) return model.error().message;
    const auto report = brittle::checkMesh(model->mesh, model->topology);
    if (!report) return report.error().message;
    EXPECT_NEAR(report->measures.volume, 1.0 / 6, 1e-6);
    return "";
}

// Expects the refusal and the note that the variant names, and no others.
inline void expectRead(const Variant& file) {
    std::vector<std::string> notes;
    const std::string refusal = refusalOf(file, notes), expected = file.refusal;
    EXPECT_EQ(refusal.empty(), expected.empty()) << refusal;
    EXPECT_NE(refusal.find(expected), std::string::npos) << refusal;
    const std::string note = notes.empty() ? "" : notes.front();
    EXPECT_LE(notes.size(), 1u);
    EXPECT_EQ(note.empty(), *file.note == '\0') << note;
    EXPECT_NE(note.find(file.note), std::string::npos) << note;
}

inline std::string nameOf(const testing::TestParamInfo<Variant>& parameter) { return parameter.param.name; }
