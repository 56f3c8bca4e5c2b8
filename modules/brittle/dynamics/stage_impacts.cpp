// What was hit in a step, for the host to hear. Before bodies are moved to where the step has brought them.
#include "modules/brittle/dynamics/step.h"
#include "shaders-spirv/shared/impact.h"

namespace brittle {

void recordImpacts(const Step& s, const std::optional<engine::BufferView>& breakable) {
    if (!s.has(Effect::Events) || !s.has(Effect::Contacts)) return;
    const StepBuffers& b = s.b.step;
    struct Push {
        float least_speed;
        uint32_t breaks;
    } push = {static_cast<float>(s.settings.impact_speed), breakable ? 1u : 0u};
    s.record.commands().beginLabel("impacts");
    s.record.run(
        "find_impacts", Length::counted(COUNT_CONTACTS), push.least_speed,
        {s.record.counts(), b.contact_slots, b.solver_contacts, b.solver_bodies, b.hits, s.b.impacts_told, s.now.contacts});
    s.record.runGroups("tell_impacts", 1, push,
                       {s.record.counts(), b.contact_slots, b.solver_contacts, b.solver_bodies, b.hits, s.b.impacts_told,
                        s.b.impacts, s.b.bodies, breakable.value_or(s.b.bodies), s.b.steps, s.now.contacts});
    s.record.commands().endLabel();
}

} // namespace brittle
