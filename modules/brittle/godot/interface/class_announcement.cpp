// How the engine is told of a class. It copies what it is told during the call.
#include "modules/brittle/godot/interface/class_record.h"
#include "modules/brittle/godot/interface/host.h"
#include "modules/brittle/godot/interface/names.h"

namespace brittle_godot {
namespace {

// A PropertyInfo and what it points at.
class Described {
public:
    Described(const Parameter& p, const Hint& hint = {}, uint32_t usage = kUsageStored | kUsageShown)
        : name_(p.name.c_str()), class_name_(p.class_name.c_str()),
          text_(hint.text), info{p.type, name_.raw(), class_name_.raw(), hint.kind, text_.raw(), usage} {}

private:
    Name name_, class_name_;
    Text text_;

public:
    PropertyInfo info;
};

class DescribedList {
public:
    explicit DescribedList(const std::vector<Parameter>& parameters) {
        for (const Parameter& p : parameters) {
            kept_.emplace_back(p);
            infos.push_back(kept_.back().info);
        }
    }

private:
    std::deque<Described> kept_;

public:
    std::vector<PropertyInfo> infos;
};

} // namespace

void ClassRecord::announce() {
    ClassInfo info = {};
    info.is_exposed = 1;
    info.notification = notify;
    info.create_instance = create;
    info.free_instance = release;
    info.class_user = this;
    host().classdb_register_extension_class4(host().library, Name(name_).raw(), Name(parent_).raw(), &info);
    for (const Constant& c : constants_)
        announceConstant(c);
    for (Method& m : methods_)
        announceMethod(m);
    for (const Property& p : properties_)
        announceProperty(p);
    for (const Signal& s : signals_)
        announceSignal(s);
}

void ClassRecord::withdraw() { host().classdb_unregister_extension_class(host().library, Name(name_).raw()); }

void ClassRecord::announceMethod(Method& method) const {
    DescribedList parameters(method.parameters);
    Described result(method.result);
    Name name(method.name.c_str());
    std::vector<int32_t> metadata(method.parameters.size(), 0);
    MethodInfo info = {};
    info.name = name.raw();
    info.user = &method;
    info.call = call;
    info.ptrcall = callPlain;
    info.flags = kMethodNormal;
    info.has_result = method.result.type != Type::Nil ? 1 : 0;
    info.result = info.has_result != 0 ? &result.info : nullptr;
    info.argument_count = static_cast<uint32_t>(parameters.infos.size());
    info.arguments = parameters.infos.data();
    info.argument_metadata = metadata.data();
    host().classdb_register_extension_class_method(host().library, Name(name_).raw(), &info);
}

void ClassRecord::announceProperty(const Property& p) const {
    if (p.name.empty()) {
        host().classdb_register_extension_class_property_group(host().library, Name(name_).raw(), Text(p.title).raw(),
                                                               Text(p.prefix).raw());
        return;
    }
    const std::string class_name = p.hint.kind == kHintResourceType ? p.hint.text : "";
    const Described described({p.name, p.type, class_name}, p.hint);
    host().classdb_register_extension_class_property(host().library, Name(name_).raw(), &described.info,
                                                     Name(("set_" + p.name).c_str()).raw(),
                                                     Name(("get_" + p.name).c_str()).raw());
}

void ClassRecord::announceSignal(const Signal& signal) const {
    const DescribedList parameters(signal.parameters);
    host().classdb_register_extension_class_signal(host().library, Name(name_).raw(), Name(signal.name).raw(),
                                                   parameters.infos.data(), static_cast<int64_t>(parameters.infos.size()));
}

void ClassRecord::announceConstant(const Constant& c) const {
    host().classdb_register_extension_class_integer_constant(host().library, Name(name_).raw(), Name(c.enumeration).raw(),
                                                             Name(c.name).raw(), c.value, c.is_flag ? 1 : 0);
}

} // namespace brittle_godot
