#include "modules/brittle/effects/effect_set.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace brittle {
namespace {

constexpr EffectFacts kFacts[] = {
    {"Bodies fall.", {}},
    // Bodies that are fast for their size would pass what they touch, so contacts do not go without holding them back.
    {"Bodies touch and do not pass through each other.", {Effect::Ccd}},
    {"What touches resists sliding and twisting.", {Effect::Contacts}},
    {"What comes in fast leaves again with a share of its speed.", {Effect::Contacts}},
    {"Bodies that are fast for their size are held back where they would go too deep.", {Effect::Contacts}},
    {"Islands of bodies that have come to rest cost nothing until something touches them.", {Effect::Contacts}},
    {"Bodies break where they are hit hard enough.", {Effect::Contacts, Effect::Ccd}},
    {"Fragments break again.", {Effect::ImpactFracture}},
    {"Cells of a body hold together until a load parts them.", {Effect::Contacts}},
    {"Loads are followed through bodies, which break where they cannot carry them.", {Effect::Bonds}},
    {"What is too small for a body flies on as particles.", {Effect::ImpactFracture}},
    {"Small fragments that have come to rest fade and go.", {Effect::ImpactFracture}},
    {"The host is told what has happened.", {}},
    {"Air slows bodies by the square of their speed, and their turning.", {}},
    {"Where room for fragments runs short, the smallest and oldest at rest go.", {Effect::ImpactFracture}},
};
static_assert(std::size(kFacts) == kEffectCount);

constexpr EffectSet kNotYet = {Effect::Bonds, Effect::Stress};

} // namespace

std::vector<Effect> EffectSet::list() const {
    std::vector<Effect> effects;
    for (size_t k = 0; k < kEffectCount; k++)
        if (has(static_cast<Effect>(k))) effects.push_back(static_cast<Effect>(k));
    return effects;
}

const EffectFacts& factsOf(Effect effect) { return kFacts[static_cast<size_t>(effect)]; }

std::optional<Effect> effectOf(std::string_view name) {
    const auto found = std::ranges::find(kEffectNames, name);
    if (found == kEffectNames.end()) return std::nullopt;
    return static_cast<Effect>(found - kEffectNames.begin());
}

// What is added is looked at in turn, so that the order tells how it came in.
ResolvedEffects resolve(EffectSet listed) {
    ResolvedEffects resolved = {listed, {}};
    std::vector<Effect> open = listed.list();
    for (size_t k = 0; k < open.size(); k++)
        for (const Effect needed : factsOf(open[k]).needs.list()) {
            if (resolved.set.has(needed)) continue;
            resolved.set.add(needed);
            resolved.added.push_back({needed, open[k]});
            open.push_back(needed);
        }
    return resolved;
}

engine::Result<ResolvedEffects> resolve(std::span<const std::string> listed) {
    EffectSet set;
    for (const std::string& name : listed) {
        const auto effect = effectOf(name);
        if (!effect)
            return engine::Error{engine::ErrorCode::BadInput,
                                 "there is no effect \"" + name + "\"; brittle scenes --keys lists them"};
        if (std::string refusal = refusalOf(name); !refusal.empty())
            return engine::Error{engine::ErrorCode::BadInput, std::move(refusal)};
        set.add(*effect);
    }
    return resolve(set);
}

std::string refusalOf(std::string_view name) {
    const auto effect = effectOf(name);
    if (!effect || !kNotYet.has(*effect)) return {};
    return "the effect '" + std::string(name) + "' has a place and is not there yet; leave it out";
}

} // namespace brittle
