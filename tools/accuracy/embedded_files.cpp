#include "tools/accuracy/embedded_files.h"

#include "engine/check.h"

#include <algorithm>
#include <iterator>

// In the order of embedded_files.S.in, one behind the other.
extern "C" {
extern const char brittle_report_begin[], brittle_style_begin[], brittle_figures_begin[], brittle_pareto_begin[],
    brittle_page_begin[], brittle_window_begin[], brittle_files_end[];
}

namespace accuracy {

std::string_view embeddedFile(std::string_view name) {
    struct File {
        std::string_view name, bytes;
    };
    const File files[] = {
        {kReportTemplate, {brittle_report_begin, brittle_style_begin}},
        {kReportStyle, {brittle_style_begin, brittle_figures_begin}},
        {kReportScripts[0], {brittle_figures_begin, brittle_pareto_begin}},
        {kReportScripts[1], {brittle_pareto_begin, brittle_page_begin}},
        {kReportScripts[2], {brittle_page_begin, brittle_window_begin}},
        {kWindowScene, {brittle_window_begin, brittle_files_end}},
    };
    const auto found = std::ranges::find(files, name, &File::name);
    ENGINE_ASSERT(found != std::end(files));
    return found->bytes;
}

} // namespace accuracy
