// What a world can do, one effect at a time. A scene lists what it calls for, what that needs comes along, and the set that
// this makes is frozen when the world is made: an effect that is not in it has no buffers, no passes and no code on the device.
#pragma once

#include "engine/result.h"

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace brittle {

enum class Effect : uint8_t {
    Gravity,
    Contacts,
    Friction,
    Restitution,
    Ccd,
    Sleeping,
    ImpactFracture,
    Refracture,
    Bonds,
    Stress,
    Dust,
    DebrisLifetime,
    Events,
    Drag,
    DebrisRoom
};
constexpr size_t kEffectCount = static_cast<size_t>(Effect::DebrisRoom) + 1;

// As scenes have them, in the order of Effect.
inline constexpr std::array<std::string_view, kEffectCount> kEffectNames = {
    "gravity", "contacts", "friction", "restitution",     "ccd",    "sleeping", "impact_fracture", "refracture",
    "bonds",   "stress",   "dust",     "debris_lifetime", "events", "drag",     "debris_room"};

class EffectSet {
public:
    constexpr EffectSet() = default;
    constexpr EffectSet(std::initializer_list<Effect> effects) {
        for (const Effect effect : effects)
            add(effect);
    }
    constexpr bool has(Effect effect) const { return (bits_ & bitOf(effect)) != 0; }
    constexpr void add(Effect effect) { bits_ |= bitOf(effect); }
    constexpr bool operator==(const EffectSet&) const = default;
    std::vector<Effect> list() const; // in the order of Effect

private:
    static constexpr uint32_t bitOf(Effect effect) { return 1u << static_cast<uint32_t>(effect); }
    uint32_t bits_ = 0;
};

struct EffectFacts {
    std::string_view sentence; // what it does
    EffectSet needs;           // directly
};

const EffectFacts& factsOf(Effect effect);
constexpr std::string_view nameOf(Effect effect) { return kEffectNames[static_cast<size_t>(effect)]; }
std::optional<Effect> effectOf(std::string_view name);

// An effect that nobody listed, and who called for it: the first that needs it directly, of those listed and then of those
// added.
struct AddedEffect {
    Effect effect = Effect::Gravity, called_by = Effect::Gravity;
    bool operator==(const AddedEffect&) const = default;
};

struct ResolvedEffects {
    EffectSet set; // with all that they need
    std::vector<AddedEffect> added;
};

ResolvedEffects resolve(EffectSet listed);
// By their names. Errors: BadInput for a name that is none, and for effects that have a place and cannot be asked for yet.
engine::Result<ResolvedEffects> resolve(std::span<const std::string> listed);
// Why an effect of that name cannot be asked for, with what to do; empty where it can.
std::string refusalOf(std::string_view name);

} // namespace brittle
