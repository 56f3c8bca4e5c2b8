// How a BrittleWorld3D takes in what its world tells: places what moved, shows fragments, and says what broke.
#include "modules/brittle/godot/interface/messages.h"
#include "modules/brittle/godot/nodes/brittle_world.h"
#include "modules/brittle/godot/nodes/budgets.h"

#include <string>

namespace brittle_godot {
namespace {

std::string lackedIn(const BrittleBudget& lacked) {
    std::string text;
    for (const auto& [name, amount] : kBudgets)
        if (lacked.*amount > 0) text += std::string("; ") + name + " lacks " + std::to_string(lacked.*amount);
    return text;
}

} // namespace

// Who is meant by events is looked up before what has broken is forgotten, and said when all is in place.
bool WorldNode::takeIn(const Report& report) {
    if (!report.failure.empty()) {
        fail(report.failure);
        return false;
    }
    if (!report.warning.empty()) tellWarning(self().call("to_string").asString() + ": " + report.warning);
    const std::vector<Emission> emissions = emissionsOf(report);
    addFragments(report);
    placeBodies(report.bodies);
    return emit(emissions);
}

size_t WorldNode::linkOf(uint64_t id) const {
    if (const auto found = link_of_.find(id); found != link_of_.end()) return found->second;
    const DrawnFragment* fragment = fragments_->find(id);
    return fragment == nullptr ? kNone : fragment->link;
}

Value WorldNode::nodeOf(size_t link) const {
    const BodyNode* node = link == kNone ? nullptr : links_[link].node;
    return node == nullptr ? Value() : node->self();
}

Value WorldNode::bodyOf(const DrawnFragment& fragment) const { return nodeOf(fragment.link); }

void WorldNode::addFragments(const Report& report) {
    std::unordered_map<uint64_t, uint64_t> origin_of;
    for (const BrittleBodyState& state : report.bodies)
        if (state.is_fragment != 0) origin_of[state.body.id] = state.origin.id;
    for (const FragmentSurface& surface : report.surfaces) {
        const size_t link = linkOf(origin_of[surface.id]);
        if (link != kNone && links_[link].node != nullptr) fragments_->add(surface, link, *links_[link].node);
    }
}

void WorldNode::placeBodies(const std::vector<BrittleBodyState>& states) {
    std::vector<bool> is_there(links_.size(), false);
    fragments_->beginPlacing();
    for (const BrittleBodyState& state : states) {
        if (state.is_fragment != 0) {
            fragments_->place(state);
        } else if (const auto found = link_of_.find(state.body.id); found != link_of_.end()) {
            is_there[found->second] = true;
            placeBody(found->second, state);
        }
    }
    fragments_->endPlacing();
    hideBroken(is_there);
}

// What never moves, and what sleeps and slept before, is left where its node has it.
void WorldNode::placeBody(size_t link, const BrittleBodyState& state) {
    const Link& l = links_[link];
    if (l.node == nullptr || state.is_collider != 0) return;
    const bool rests = state.is_asleep != 0 || state.mass == 0;
    if (!(rests && is_resting_[link] && l.node->isWhole(l.copy)))
        l.node->show(l.copy, transformOf(state.shape_position, state.shape_rotation, l.from_body));
    is_resting_[link] = rests;
}

void WorldNode::hideBroken(const std::vector<bool>& is_there) {
    for (size_t k = 0; k < links_.size(); ++k) {
        BodyNode* node = links_[k].node;
        if (node == nullptr) continue;
        if (!is_there[k] && node->isWhole(links_[k].copy)) node->hide(links_[k].copy);
        if (k + 1 == links_.size() || links_[k + 1].node != node) node->finishMoves(); // copies follow each other
    }
}

std::vector<WorldNode::Emission> WorldNode::emissionsOf(const Report& report) {
    std::vector<Emission> emissions;
    for (const BrittleBreak& event : report.breaks)
        addEmissions(event, emissions);
    for (const BrittleImpact& event : report.impacts)
        addEmissions(event, emissions);
    return emissions;
}

int64_t WorldNode::copyOf(size_t link) const { return link == kNone ? 0 : static_cast<int64_t>(links_[link].copy); }

// Of both that met; the world tells it once, of the first that is there.
void WorldNode::addEmissions(const BrittleImpact& event, std::vector<Emission>& emissions) {
    bool is_first = true;
    for (size_t k = 0; k < 2; ++k) {
        const size_t link = linkOf(event.bodies[k].id);
        const Value body = nodeOf(link), by = nodeOf(linkOf(event.bodies[1 - k].id));
        if (body.isNull()) continue;
        const double side = k == 0 ? 1 : -1;
        const BrittleVec3 normal = {side * event.normal.x, side * event.normal.y, side * event.normal.z};
        emissions.push_back(
            {body,
             "impact",
             {Value(toEngine(event.position)), Value(toEngine(normal)), event.speed, event.energy, by, copyOf(link)},
             is_first});
        is_first = false;
    }
}

// A blow that breaks something is an impact as well; one that does not is told as such once it is solved.
void WorldNode::addEmissions(const BrittleBreak& event, std::vector<Emission>& emissions) {
    const size_t link = linkOf(event.body.id);
    const Value body = nodeOf(link), by = nodeOf(linkOf(event.hit_by.id));
    const Value position(toEngine(event.position)), normal(toEngine(event.normal));
    if (event.outcome == BRITTLE_GONE) return;
    if (event.outcome != BRITTLE_BROKE) return warnOfWhole(event);
    const double energy = 0.5 * event.effective_mass * event.speed * event.speed;
    emissions.push_back({body, "impact", {position, normal, event.speed, energy, by, copyOf(link)}});
    emissions.push_back(
        {body,
         "fractured",
         {position, normal, event.speed, event.crack_energy, static_cast<int64_t>(event.fragments), by, copyOf(link)}});
}

// Once for each reason that a budget can do something about: that cracks would cost more than a blow has is no fault of the
// scene's.
void WorldNode::warnOfWhole(const BrittleBreak& event) {
    if (event.outcome == BRITTLE_WHOLE_TOO_DEAR || event.outcome == BRITTLE_WHOLE_ONE_PIECE) return;
    if ((told_outcomes_ & 1u << event.outcome) != 0) return;
    told_outcomes_ |= 1u << event.outcome;
    std::string why = "it could not be cut, or the budget of a step was too small";
    if (event.outcome == BRITTLE_WHOLE_NO_ROOM) why = "there is no room for its fragments";
    if (event.outcome == BRITTLE_WHOLE_TOO_LARGE) why = "no step has room for it";
    if (event.outcome == BRITTLE_WHOLE_NO_PAIRS) why = "there is no room for the pairs and contacts that its fragments need";
    tellWarning(self().call("to_string").asString() + ": a body that was hit hard enough stays whole: " + why +
                lackedIn(event.lacked));
}

bool WorldNode::emit(const std::vector<Emission>& emissions) {
    const auto is_alive = is_alive_;
    const uint64_t generation = generation_;
    const auto goes_on = [&] { return *is_alive && generation_ == generation; };
    for (const Emission& e : emissions) {
        std::vector<Value> arguments = {e.name};
        arguments.insert(arguments.end(), e.arguments.begin(), e.arguments.end());
        if (!e.body.isNull()) e.body.call("emit_signal", arguments);
        if (!goes_on()) return false;
        if (!e.is_the_worlds) continue;
        arguments.insert(arguments.begin() + 1, e.body);
        self().call("emit_signal", arguments);
        if (!goes_on()) return false;
    }
    return true;
}

} // namespace brittle_godot
