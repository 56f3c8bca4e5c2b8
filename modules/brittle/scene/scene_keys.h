// The keys of a scene file, in one table. The reader, the writer, the checks, the help and the reference in README.md are all
// made from it: a key that is not in the table does not exist, and one that is cannot be undocumented.
#pragma once

#include "modules/brittle/scene/scene_description.h"

#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace brittle {

// One of the names that the key allows, by its number.
struct ChoiceRef {
    uint8_t* number;
};
using ValueRef = std::variant<double*, std::optional<double>*, uint32_t*, uint64_t*, bool*, std::string*, ChoiceRef, Double3*,
                              Quaternion*, std::vector<Double3>*, std::vector<std::string>*>;

struct Allowed {
    double lower = -std::numeric_limits<double>::infinity(), upper = std::numeric_limits<double>::infinity();
    bool above_lower = false;                // the lower bound itself is not allowed
    std::span<const std::string_view> names; // of choices, of texts that are names, of lists of names
    std::span<const uint32_t> numbers;       // instead of a range
    bool has_own_names = false;              // the scene may add to the names; whether it does is checked with the whole scene
};

// Which shapes a key of a shape is for; bits by ShapeKind.
using ShapeBits = uint32_t;
constexpr ShapeBits bitOf(ShapeKind kind) { return 1u << static_cast<uint32_t>(kind); }
constexpr ShapeBits kEveryShape = ~0u;

struct SceneKey {
    std::string_view name;
    ValueRef (*locate)(void* owner) = nullptr; // in an owner of the section's type
    Allowed allowed;
    std::string_view unit; // "" for none
    std::string_view meaning;
    ShapeBits shapes = kEveryShape;
};

enum class SectionId : uint8_t { Scene, Step, Breaking, Dust, Debris, Events, Budgets, Camera, Material, Body, Collider };

struct SceneSection {
    SectionId id = SectionId::Scene;
    std::string_view name;    // of the table in the file; "" for the top level
    bool is_repeated = false; // an array of tables
    std::span<const SceneKey> keys;
    std::string_view meaning;
};

std::span<const SceneSection> sceneSections(); // in the order in which they are written
const SceneSection& sectionOf(SectionId id);
const SceneKey* findKey(const SceneSection& section, std::string_view name); // nullptr where there is none
std::string headingOf(const SceneSection& section);                          // "[step]", "[[body]]", "the scene"

// The part of the scene that a section's keys are about; `index` counts those of a repeated section.
void* ownerOf(SceneDescription& scene, SectionId id, size_t index);
size_t countOf(const SceneDescription& scene, SectionId id);
void addOwner(SceneDescription& scene, SectionId id); // one more, at the end, of a repeated section
// The shape that an owner has, nullptr where it has none.
const ShapeDescription* shapeOf(const void* owner, SectionId id);
// As the section's owner is when nothing was said about it.
ValueRef defaultOf(const SceneSection& section, const SceneKey& key);

std::span<const std::string_view> shapeNames();    // by ShapeKind
std::span<const std::string_view> materialNames(); // the built-in ones

// "a number from 0 to 1", "three numbers, each above 0 and at most 1e+06 (m)", "one of box, ball".
std::string describeAllowed(const SceneKey& key);
// What is wrong with a value, in the words "is 1.5", "holds nan"; "" where nothing is.
std::string faultOf(const ValueRef& value, const Allowed& allowed);
// To the last bit of every number.
bool sameValue(const ValueRef& a, const ValueRef& b);
// As a scene file has it; empty for what is not there. Numbers as the shortest text that is the same number again.
std::string formatValue(const ValueRef& value, const Allowed& allowed);

// The keys as Markdown tables, and as text for a terminal.
std::string sceneKeyReference();
std::string sceneKeyHelp();

} // namespace brittle
