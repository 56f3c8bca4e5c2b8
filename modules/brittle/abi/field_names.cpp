#include "modules/brittle/abi/field_names.h"

#include <string_view>

namespace brittle::abi {
namespace {

struct Name {
    std::string_view key, field;
};

// Keys of files whose fields are called otherwise, and what only files can say.
constexpr Name kNames[] = {{"material 'own': ", ""}, // a name that the library gives
                           {"'place'", "'position'"},
                           {"'turn'", "'rotation'"},
                           {", or an axis and degrees", ""},
                           {"nothing is in the scene; give it a [[body]]", "the world has no body; call brittleAddBody"},
                           {"needs 'points' or a 'file'", "needs 'points'"},
                           {"is 'fixed' and has a", "has 'is_fixed' = 1 and a"},
                           {"'lifetime'", "'dust_lifetime'"},
                           {"'below'", "'debris_below'"},
                           {"'after'", "'debris_after'"},
                           {"'fade'", "'debris_fade'"}};

} // namespace

std::string inFieldNames(std::string message) {
    for (const auto& [key, field] : kNames)
        if (const size_t at = message.find(key); at != std::string::npos) message.replace(at, key.size(), field);
    return message;
}

} // namespace brittle::abi
