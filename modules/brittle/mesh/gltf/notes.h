// Collects what the reader leaves out, one sentence per kind.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace brittle::gltf {

class Notes {
public:
    // Adds the sentence unless it is there already.
    void add(const std::string& sentence);
    // Counts one more; the sentence is "3 MANY are left out: WHY". " them" in WHY becomes " it" for one.
    void leaveOut(const char* one, const char* many, const char* why, uint64_t count = 1);
    // Counts one more; the sentence is "3 MANY".
    void count(const char* one, const char* many);
    std::vector<std::string> sentences() const;

private:
    struct Kind {
        std::string one, many, why; // no reason if nothing is left out
        uint64_t count = 0;
    };
    std::vector<Kind> kinds_;
    std::vector<std::string> sentences_;
};

} // namespace brittle::gltf
