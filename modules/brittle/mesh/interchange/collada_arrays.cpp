#include "modules/brittle/mesh/interchange/collada_arrays.h"

#include "modules/brittle/mesh/text_reader.h"

#include <limits>

namespace brittle {
namespace {

uint64_t integerOf(const Tag& tag, std::string_view attribute, uint64_t without) {
    return Words(tag.value(attribute)).nextInt<uint64_t>().value_or(without);
}

} // namespace

std::optional<ColladaFault> ColladaArrays::check(const Tag& tag) {
    if (accessor_ && tag.name == "param") {
        ++accessor_->params;
        accessor_->has_names |= !tag.value("name").empty();
        return std::nullopt;
    }
    if (accessor_) {
        const Accessor finished = *accessor_;
        accessor_.reset();
        if (auto fault = checkAccessor(finished)) return fault;
    }
    if (tag.name == "float_array") return checkArray(tag);
    if (tag.name == "accessor")
        accessor_ = {tag.name, tag.value("source"), integerOf(tag, "offset", 0), integerOf(tag, "count", 0),
                     integerOf(tag, "stride", 1)};
    return std::nullopt;
}

std::optional<ColladaFault> ColladaArrays::checkArray(const Tag& tag) {
    const uint64_t count = integerOf(tag, "count", 0);
    uint64_t found = 0;
    Words words(tag.content);
    for (std::string_view word = words.next(); !word.empty(); word = words.next(), ++found)
        if (!parseColladaNumber(word))
            return ColladaFault{word, "an array holds something that is not a number; export the file again"};
    if (found < count)
        return ColladaFault{tag.name, "float_array has " + std::to_string(found) + " numbers, its count is " +
                                          std::to_string(count) + "; the file is damaged, export it again"};
    if (found > count) ++long_arrays_;
    sizes_[tag.value("id")] = count;
    return std::nullopt;
}

std::optional<ColladaFault> ColladaArrays::checkAccessor(const Accessor& accessor) const {
    if (!accessor.source.starts_with('#')) return std::nullopt;
    const auto size = sizes_.find(accessor.source.substr(1));
    if (size == sizes_.end() || accessor.count == 0) return std::nullopt;
    if (accessor.params >= 3 && !accessor.has_names)
        return ColladaFault{accessor.at, "an accessor whose params have no names, such as X, Y and Z; export the file again"};
    const uint64_t last = accessor.params > 0 ? accessor.params : 1; // numbers of the last element
    const bool fits = accessor.offset <= size->second && last <= size->second - accessor.offset &&
                      (accessor.stride == 0 || accessor.count - 1 <= (size->second - accessor.offset - last) / accessor.stride);
    if (fits) return std::nullopt;
    return ColladaFault{accessor.at, "an accessor of " + std::to_string(accessor.count) +
                                         " elements reaches beyond its array of " + std::to_string(size->second) +
                                         " numbers; export the file again"};
}

} // namespace brittle
