#include "tools/brittle/numbered_name.h"

#include <regex>

namespace cli {

std::optional<NumberedName> NumberedName::parse(const std::string& name) {
    static const std::regex kOnce("([^%]*)%(?:0([1-9]))?d([^%]*)");
    std::smatch parts;
    if (!std::regex_match(name, parts, kOnce)) return {};
    NumberedName numbered;
    numbered.before_ = parts[1];
    numbered.after_ = parts[3];
    numbered.width_ = parts[2].matched ? static_cast<size_t>(parts[2].str()[0] - '0') : 0;
    return numbered;
}

std::string NumberedName::of(size_t number) const {
    const std::string digits = std::to_string(number);
    return before_ + std::string(width_ > digits.size() ? width_ - digits.size() : 0, '0') + digits + after_;
}

} // namespace cli
