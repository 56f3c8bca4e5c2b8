#include "tools/device_check/results.h"

#include <string_view>

// The page lies between the two (page/embedded_page.S.in).
extern "C" const char brittle_check_page_begin[], brittle_check_page_end[];

namespace device_check {

constexpr std::string_view kPlace = "/*RESULTS*/null";

// "</" would end the script that the results stand in.
std::string pageOf(const std::string& results) {
    std::string page(brittle_check_page_begin, brittle_check_page_end), json = results;
    for (size_t at = json.find("</"); at != std::string::npos; at = json.find("</", at + 3))
        json.insert(at + 1, "\\");
    const size_t place = page.find(kPlace);
    return place == std::string::npos ? page : page.replace(place, kPlace.size(), json);
}

} // namespace device_check
