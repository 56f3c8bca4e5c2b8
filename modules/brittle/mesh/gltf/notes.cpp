#include "modules/brittle/mesh/gltf/notes.h"

#include "modules/brittle/mesh/format.h"

#include <algorithm>

namespace brittle::gltf {
namespace {

constexpr size_t kMostSentences = 50;

std::string singular(std::string why) {
    constexpr std::string_view kMany = " them", kOne = " it";
    if (const size_t at = why.find(kMany); at != why.npos) why.replace(at, kMany.size(), kOne);
    return why;
}

} // namespace

void Notes::add(const std::string& sentence) {
    if (sentences_.size() == kMostSentences || std::ranges::count(sentences_, sentence) > 0) return;
    sentences_.push_back(sentence);
}

void Notes::leaveOut(const char* one, const char* many, const char* why, uint64_t count) {
    if (count == 0) return;
    for (Kind& kind : kinds_)
        if (kind.one == one && kind.why == why) {
            kind.count += count;
            return;
        }
    kinds_.push_back({one, many, why, count});
}

void Notes::count(const char* one, const char* many) { leaveOut(one, many, ""); }

std::vector<std::string> Notes::sentences() const {
    std::vector<std::string> sentences;
    for (const Kind& kind : kinds_) {
        const std::string end = kind.count == 1 ? " is left out: " + singular(kind.why) : " are left out: " + kind.why;
        sentences.push_back(formatCount(kind.count, kind.one, kind.many) + (kind.why.empty() ? "" : end));
    }
    sentences.insert(sentences.end(), sentences_.begin(), sentences_.end());
    return sentences;
}

} // namespace brittle::gltf
