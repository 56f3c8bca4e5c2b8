// Files of the tree that lie in the program.
#pragma once

#include <string_view>

namespace accuracy {

constexpr const char* kReportTemplate = "report.html";
constexpr const char* kReportStyle = "report.css";
constexpr const char* kReportScripts[] = {"figures.js", "pareto.js", "page.js"}; // in this order
constexpr const char* kWindowScene = "window_pane.toml";

std::string_view embeddedFile(std::string_view name); // one of these

} // namespace accuracy
