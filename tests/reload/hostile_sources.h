// Sources that ask too much of a compiler.
#pragma once

#include <string>

namespace reload_test {

// Of a kernel with the buffer b: deeper than a stack is.
inline std::string sumOfTerms(int terms) {
    std::string sum = "b[1]";
    for (int k = 1; k < terms; ++k)
        sum += "+b[1]";
    return "void main() { b[0] = " + sum + "; }\n";
}

// Each line is twice the one before: no machine gets to the end of forty of them.
inline std::string doublingMacros(int lines) {
    std::string text = "#define M0 b[0] += 1u;\n";
    for (int k = 1; k <= lines; ++k)
        text += "#define M" + std::to_string(k) + " M" + std::to_string(k - 1) + " M" + std::to_string(k - 1) + "\n";
    return text + "void main() { M" + std::to_string(lines) + " }\n";
}

} // namespace reload_test
