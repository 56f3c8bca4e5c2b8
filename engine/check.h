// Assertions: for bugs of ours, never for what the world may hand us. One that fails throws: a program that catches nothing
// ends with the message, a library that lives in another's process catches it at its boundary and lives on.
#pragma once

#include <stdexcept>
#include <string>

namespace engine {

class BrokenAssertion : public std::logic_error {
public:
    BrokenAssertion(const char* file, int line, const char* condition)
        : logic_error(std::string(file) + ":" + std::to_string(line) + ": assertion failed: " + condition) {}
};

} // namespace engine

// On in every build unless ENGINE_NO_ASSERTS is defined: none stands in a hot loop.
#ifdef ENGINE_NO_ASSERTS
#define ENGINE_ASSERT(condition) ((void)0)
#else
#define ENGINE_ASSERT(condition)                                                                                               \
    do {                                                                                                                       \
        if (!(condition)) throw engine::BrokenAssertion(__FILE__, __LINE__, #condition);                                       \
    } while (false)
#endif
