// What brittle doctor prints.
#pragma once

#include "modules/brittle/mesh/diagnosis.h"
#include "modules/brittle/mesh/repair/repair.h"

#include <string>
#include <vector>

namespace cli {

struct DoctorReport {
    std::string name;
    const brittle::PreparedMesh* model = nullptr;
    brittle::MeshDiagnosis diagnosis;
    const brittle::RepairNotes* mended = nullptr; // where it was asked for
    std::vector<std::string> reader_notes;        // what the reader of the file left out
};

// For reading: counts of everything, and the first few places of each kind.
void printReport(const DoctorReport& report);
// Everything, with every place.
void printReportJson(const DoctorReport& report);

} // namespace cli
