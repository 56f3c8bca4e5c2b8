#include "engine/kernel_interface.h"

#include <algorithm>
#include <optional>

namespace engine {

namespace {

using Of = InterfaceChange::Of;

std::string usedAs(const ReflectedBinding& binding) {
    return binding.readonly ? "read" : binding.writeonly ? "written" : "read and written";
}

struct FieldChange {
    std::string holder, why;
};

// The first of which layout or number differ; names are left alone.
std::optional<FieldChange> firstChange(const std::vector<ReflectedField>& host, const std::vector<ReflectedField>& now) {
    for (size_t k = 0; k < std::max(host.size(), now.size()); ++k) {
        if (k >= now.size()) return FieldChange{"", "`" + host[k].path + "` is gone"};
        const std::string is = "`" + now[k].path + "` is " + now[k].layout;
        if (k >= host.size()) return FieldChange{now[k].holder, is + ", the host knows nothing of it"};
        if (host[k].layout != now[k].layout) return FieldChange{now[k].holder, is + ", the host has " + host[k].layout};
    }
    return std::nullopt;
}

class Comparison {
public:
    Comparison(const Reflection& host, const Reflection& now) : host_(host), now_(now) {}

    std::vector<InterfaceChange> run() {
        if (host_.stage != now_.stage) add({Of::Stage, 0, 0, "", "it is of another stage than the host's"});
        compareBindings();
        comparePush();
        compareConstants();
        compareGroupSize();
        return std::move(changes_);
    }

private:
    void add(InterfaceChange change) { changes_.push_back(std::move(change)); }

    static const ReflectedBinding* find(const Reflection& reflection, const ReflectedBinding& like) {
        const auto found = std::ranges::find_if(
            reflection.bindings, [&](const ReflectedBinding& b) { return b.set == like.set && b.binding == like.binding; });
        return found == reflection.bindings.end() ? nullptr : &*found;
    }

    static std::string called(const ReflectedBinding& binding) {
        return "binding " + std::to_string(binding.binding) + " of set " + std::to_string(binding.set) + " (" + binding.name +
               ")";
    }

    void compareBindings() {
        for (const ReflectedBinding& binding : host_.bindings)
            if (find(now_, binding) == nullptr)
                add({Of::Binding, binding.set, binding.binding, "", called(binding) + " is gone, the host still binds it"});
        for (const ReflectedBinding& binding : now_.bindings)
            if (const ReflectedBinding* before = find(host_, binding))
                compareBinding(*before, binding);
            else
                add({Of::Binding, binding.set, binding.binding, "", called(binding) + " is new, the host binds nothing there"});
    }

    void compareBinding(const ReflectedBinding& before, const ReflectedBinding& binding) {
        const auto differs = [&](const std::string& holder, const std::string& why) {
            add({Of::Binding, binding.set, binding.binding, holder, called(binding) + ": " + why});
        };
        if (before.storage_buffer != binding.storage_buffer) return differs("", "is of another kind than the host's");
        if (usedAs(before) != usedAs(binding))
            differs("", "is " + usedAs(binding) + " now, for the host it is " + usedAs(before));
        if (const auto change = firstChange(before.fields, binding.fields)) differs(change->holder, change->why);
    }

    void comparePush() {
        if (now_.push_fields.empty()) return; // the host goes on pushing what nobody looks at
        if (const auto change = firstChange(host_.push_fields, now_.push_fields))
            add({Of::PushConstants, 0, 0, change->holder, "push constants: " + change->why});
    }

    void compareConstants() {
        const auto has = [](const Reflection& r, uint32_t id) { return std::ranges::binary_search(r.spec_ids, id); };
        const auto called = [](const Reflection& r, size_t k) {
            return "constant_id " + std::to_string(r.spec_ids[k]) +
                   (r.spec_names[k].empty() ? "" : " (" + r.spec_names[k] + ")");
        };
        for (size_t k = 0; k < host_.spec_ids.size(); ++k)
            if (!has(now_, host_.spec_ids[k]))
                add({Of::Constant, 0, host_.spec_ids[k], "", called(host_, k) + " is gone, the host still sets it"});
        for (size_t k = 0; k < now_.spec_ids.size(); ++k)
            if (!has(host_, now_.spec_ids[k]))
                add({Of::Constant, 0, now_.spec_ids[k], "", called(now_, k) + " is new, the host does not set it"});
    }

    // A size that the host sets is as the host sets it, whatever stands there.
    void compareGroupSize() {
        if (host_.local_size_ids != now_.local_size_ids)
            return add({Of::GroupSize, 0, 0, "",
                        "the size of workgroups is set by another specialization constant than the host sets"});
        for (size_t k = 0; k < 3; ++k)
            if (!host_.local_size_ids[k] && host_.local_size[k] != now_.local_size[k])
                add({Of::GroupSize, 0, 0, "",
                     "workgroups have " + std::to_string(now_.local_size[k]) + " lanes along " + "xyz"[k] +
                         ", the host counts on " + std::to_string(host_.local_size[k])});
    }

    const Reflection& host_;
    const Reflection& now_;
    std::vector<InterfaceChange> changes_;
};

} // namespace

std::vector<InterfaceChange> interfaceChanges(const Reflection& host, const Reflection& now) {
    return Comparison(host, now).run();
}

} // namespace engine
