#include "tools/accuracy/report.h"

#include "engine/check.h"
#include "tools/accuracy/embedded_files.h"

namespace accuracy {
namespace {

// No text of the results ends the element that they stand in.
std::string insideScript(const std::string& json) {
    std::string safe;
    for (const char c : json)
        safe += c == '<' ? "\\u003c" : std::string(1, c);
    return safe;
}

void fill(std::string& page, std::string_view place, std::string_view text) {
    const size_t found = page.find(place);
    ENGINE_ASSERT(found != std::string::npos);
    page.replace(found, place.size(), text);
}

std::string toldError(const Results& results, const MeasuredError* error) {
    if (error == nullptr) return "not measured";
    const std::string unit = " " + kindOf(results, error->kind)->unit;
    return (error->value <= error->resolution ? "below " + shortNumber(error->resolution) : shortNumber(error->value)) + unit;
}

const Measurement* defaultOf(const Results& results, const std::string& workload) {
    for (const Measurement& m : results.measurements)
        if (m.workload == workload && m.is_default) return &m;
    return nullptr;
}

} // namespace

std::string encodeReport(const Results& results) {
    std::string scripts;
    for (const char* script : kReportScripts)
        scripts += embeddedFile(script);
    std::string page(embeddedFile(kReportTemplate));
    fill(page, "@STYLE@", embeddedFile(kReportStyle));
    fill(page, "@SCRIPT@", scripts);
    fill(page, "@RESULTS@", insideScript(encodeResults(results)));
    return page;
}

std::string usefulTable(const Results& results) {
    std::string table = "| setting | on | time | error | the default's | what one loses |\n|---|---|---|---|---|---|\n";
    for (const UsefulLine& line : results.useful) {
        const Measurement& m = results.measurements[line.measurement];
        const Measurement* usual = defaultOf(results, m.workload);
        const std::string times = shortNumber(m.ms.median) + " ms (x " + shortNumber(m.times_default) + ")";
        table += "| " + m.knob + " " + m.setting + " | `" + m.workload + "` | " + times + " | " +
                 toldError(results, comparedBy(results, m)) + " | " +
                 (usual == nullptr ? "" : toldError(results, comparedBy(results, *usual))) + " | " + m.loses + " |\n";
    }
    return table;
}

} // namespace accuracy
