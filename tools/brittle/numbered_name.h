// The name of a file for every frame, as film tools write it: "fall_%04d.png".
#pragma once

#include <optional>
#include <string>

namespace cli {

class NumberedName {
public:
    // None where there is no place for a number, or more than one, in the name: then it is the name of one file.
    static std::optional<NumberedName> parse(const std::string& name);
    std::string of(size_t number) const; // with zeros in front, up to the width that was asked for

private:
    std::string before_, after_;
    size_t width_ = 0;
};

} // namespace cli
