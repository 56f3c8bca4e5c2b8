#include "tests/godot/fake_engine.h"

#include <algorithm>
#include <dlfcn.h>

namespace godot_test {
namespace {

using namespace brittle_godot;

FakeEngine* the_engine = nullptr;

// Names and strings come as plain values.
std::string textAt(const void* native) {
    const auto read = reinterpret_cast<int64_t (*)(const void*, char*, int64_t)>(valueFunction("string_to_utf8_chars"));
    std::string text(static_cast<size_t>(read(native, nullptr, 0)), '\0');
    read(native, text.data(), static_cast<int64_t>(text.size()));
    return text;
}

void printError(const char* description, const char*, const char*, const char*, int32_t, uint8_t) {
    engine().errors.emplace_back(description);
}
void printWarning(const char* description, const char*, const char*, const char*, int32_t, uint8_t) {
    engine().warnings.emplace_back(description);
}

std::vector<Any> argumentsAt(const void* const* variants, int64_t count) {
    std::vector<Any> arguments;
    for (int64_t k = 0; k < count; ++k)
        arguments.push_back(Any::copyOf(variants[k]));
    return arguments;
}

void variantCall(void* at, const void* name, const void* const* variants, int64_t count, void* result, CallError* error) {
    Any self = Any::copyOf(at);
    const std::string method = textAt(name);
    Called called;
    if (self.type() == Type::Object && self.asObject() == nullptr)
        called.error.error = kCallInstanceIsNull;
    else if (self.type() == Type::Object)
        called = engine().callMethod(self.asObject(), method, argumentsAt(variants, count));
    else if (method == "size")
        called.result = Any(static_cast<int64_t>(self.size()));
    else if (method == "resize" && count == 1) {
        // A Variant shares arrays with its copies, but not packed ones.
        if (self.type() == Type::Array)
            self.resize(static_cast<size_t>(Any::copyOf(variants[0]).asInt()));
        else {
            self.resize(static_cast<size_t>(Any::copyOf(variants[0]).asInt()));
            reinterpret_cast<void (*)(void*)>(valueFunction("variant_destroy"))(at);
            self.writeTo(at);
        }
    } else
        called.error.error = kCallInvalidMethod;
    called.result.writeTo(result);
    *error = called.error;
}

void* getSingleton(const void* name) { return engine().singleton(textAt(name)); }
void* constructObject(const void* name) { return engine().make(textAt(name)); }

// Only Object.notification is asked for.
const void* methodBind(const void* class_name, const void* method, int64_t hash) {
    constexpr int64_t kHashOfNotification = 4023243586;
    static const int bind = 0;
    if (textAt(class_name) == "Object" && textAt(method) == "notification" && hash == kHashOfNotification) return &bind;
    complain("there is no method " + textAt(class_name) + "." + textAt(method) + " of this hash");
    return nullptr;
}
void bindPtrcall(const void*, void* object, const void* const* values, void*) {
    engine().notify(static_cast<Object*>(object), static_cast<int>(*static_cast<const int64_t*>(values[0])));
}

void* instanceFromId(uint64_t id) { return engine().find(id); }
void setInstance(void* object, const void* class_name, void* instance) {
    auto* o = static_cast<Object*>(object);
    o->class_name = textAt(class_name);
    o->extension = engine().classes.at(o->class_name).get();
    o->instance = instance;
}
void* getBinding(void* object, void* token, const BindingCallbacks*) {
    if (token == nullptr) complain("a binding is asked for without a token");
    return static_cast<Object*>(object)->binding;
}
void setBinding(void* object, void*, void* binding, const BindingCallbacks* callbacks) {
    if (callbacks == nullptr) complain("a binding is set without callbacks");
    static_cast<Object*>(object)->binding = binding;
}
void refSetObject(void* ref, void* object) {
    auto** held = static_cast<Object**>(ref);
    if (object != nullptr) reference(static_cast<Object*>(object));
    if (*held != nullptr) unreference(*held);
    *held = static_cast<Object*>(object);
}

Announced announced(const PropertyInfo& info) {
    return {textAt(info.name), textAt(info.class_name), textAt(info.hint_string), info.type, info.hint};
}
std::vector<Announced> announcedList(const PropertyInfo* infos, int64_t count) {
    std::vector<Announced> list;
    for (int64_t k = 0; k < count; ++k)
        list.push_back(announced(infos[k]));
    return list;
}

void registerClass(void* library, const void* name, const void* parent, const ClassInfo* info) {
    if (library == nullptr) complain("a class is announced without the library");
    auto made = std::make_unique<ExtensionClass>();
    made->name = textAt(name);
    made->parent = textAt(parent);
    made->info = *info;
    if (!engine().classes.emplace(made->name, std::move(made)).second) complain("a class is announced twice");
}
ExtensionClass& classAt(const void* name) { return *engine().classes.at(textAt(name)); }
void registerMethod(void*, const void* class_name, const MethodInfo* info) {
    AnnouncedMethod method;
    method.info = *info;
    method.arguments = announcedList(info->arguments, info->argument_count);
    if (info->has_result != 0) method.result = announced(*info->result);
    if (!classAt(class_name).methods.emplace(textAt(info->name), method).second) complain("a method is announced twice");
}
void registerConstant(void*, const void* class_name, const void*, const void* name, int64_t value, uint8_t) {
    if (!classAt(class_name).constants.emplace(textAt(name), value).second) complain("a constant is announced twice");
}
void registerProperty(void*, const void* class_name, const PropertyInfo* info, const void* setter, const void* getter) {
    AnnouncedProperty property;
    static_cast<Announced&>(property) = announced(*info);
    property.setter = textAt(setter);
    property.getter = textAt(getter);
    const auto& methods = classAt(class_name).methods;
    if (!methods.contains(property.setter) || !methods.contains(property.getter))
        complain("a property has no methods: " + property.name);
    if (!classAt(class_name).properties.emplace(property.name, property).second) complain("a property is announced twice");
}
void registerGroup(void*, const void*, const void* title, const void*) {
    if (textAt(title).empty()) complain("a group has no title");
}
void registerSignal(void*, const void* class_name, const void* name, const PropertyInfo* infos, int64_t count) {
    if (!classAt(class_name).signals.emplace(textAt(name), announcedList(infos, count)).second)
        complain("a signal is announced twice");
}
void unregisterClass(void*, const void* name) {
    if (engine().classes.erase(textAt(name)) != 1) complain("a class is withdrawn that is none");
}

template <class Function>
AnyFunction any(Function* function) {
    return reinterpret_cast<AnyFunction>(function);
}

AnyFunction getProcAddress(const char* name) {
    static const std::map<std::string, AnyFunction> functions = {
        {"print_error_with_message", any(printError)},
        {"print_warning_with_message", any(printWarning)},
        {"variant_call", any(variantCall)},
        {"global_get_singleton", any(getSingleton)},
        {"classdb_construct_object2", any(constructObject)},
        {"classdb_get_method_bind", any(methodBind)},
        {"object_method_bind_ptrcall", any(bindPtrcall)},
        {"object_get_instance_from_id", any(instanceFromId)},
        {"object_set_instance", any(setInstance)},
        {"object_get_instance_binding", any(getBinding)},
        {"object_set_instance_binding", any(setBinding)},
        {"ref_set_object", any(refSetObject)},
        {"classdb_register_extension_class4", any(registerClass)},
        {"classdb_register_extension_class_method", any(registerMethod)},
        {"classdb_register_extension_class_integer_constant", any(registerConstant)},
        {"classdb_register_extension_class_property", any(registerProperty)},
        {"classdb_register_extension_class_property_group", any(registerGroup)},
        {"classdb_register_extension_class_signal", any(registerSignal)},
        {"classdb_unregister_extension_class", any(unregisterClass)}};
    if (name == engine().lacks_function) return nullptr;
    if (const AnyFunction function = valueFunction(name)) return function;
    const auto found = functions.find(name);
    if (found == functions.end()) complain(std::string("the plugin asks for a function that no engine has: ") + name);
    return found == functions.end() ? nullptr : found->second;
}

} // namespace

FakeEngine& engine() { return *the_engine; }
Object* findObject(uint64_t id) { return the_engine == nullptr ? nullptr : the_engine->find(id); }
uint64_t idOf(const Object* object) { return object == nullptr ? 0 : object->id; }

void reference(Object* object) {
    if (engine().isA(*object, "RefCounted")) ++object->references;
}
void unreference(Object* object) {
    if (engine().isA(*object, "RefCounted") && --object->references == 0) engine().free(object);
}

FakeEngine::FakeEngine() {
    engineMethods(); // what these keep is there before anything is counted
    the_engine = this;
}

FakeEngine::~FakeEngine() {
    render_thread_.reset();
    singletons_.clear();
    emissions.clear();
    instances.clear();
    while (!objects_.empty())
        free(objects_.begin()->second.get());
    the_engine = nullptr;
}

// The library stays loaded, so that leaks are found with its symbols.
bool FakeEngine::load() {
    void* library = dlopen(BRITTLE_GODOT_PLUGIN, RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
        complain(dlerror());
        return false;
    }
    using Entry = uint8_t (*)(GetProcAddress, void*, Initialization*);
    const auto entry = reinterpret_cast<Entry>(dlsym(library, "brittle_godot_init"));
    if (entry(getProcAddress, this, &plugin_) == 0) return false;
    for (int32_t level = plugin_.first_level; level <= kLevelEditor; ++level)
        plugin_.initialize(plugin_.user, level);
    return true;
}

void FakeEngine::unload() {
    for (int32_t level = kLevelEditor; level >= plugin_.first_level; --level)
        plugin_.deinitialize(plugin_.user, level);
}

Object* FakeEngine::find(uint64_t id) const {
    const auto found = objects_.find(id);
    return found == objects_.end() ? nullptr : found->second.get();
}

Object* FakeEngine::singleton(const std::string& name) {
    const auto [known, is_new] = singletons_.try_emplace(name);
    if (is_new) known->second = make(name);
    return known->second;
}

bool FakeEngine::isA(const Object& object, const std::string& class_name) const {
    std::string name = object.class_name;
    while (!name.empty() && name != class_name) {
        const auto extension = classes.find(name);
        name = extension != classes.end() ? extension->second->parent : parentOf(name);
    }
    return !name.empty();
}

Object* FakeEngine::make(const std::string& class_name) {
    const auto extension = classes.find(class_name);
    if (extension != classes.end())
        return static_cast<Object*>(extension->second->info.create_instance(extension->second->info.class_user, 1));
    if (makes_nothing) return nullptr;
    if (class_name != "Object" && parentOf(class_name).empty()) complain("there is no class " + class_name);
    auto object = std::make_unique<Object>();
    object->id = nextId();
    object->class_name = class_name;
    Object* made = object.get();
    objects_.emplace(made->id, std::move(object));
    return made;
}

// What it keeps may be the last to hold others, which go as well.
void FakeEngine::free(Object* object) {
    while (!object->children.empty())
        free(object->children.back());
    if (object->is_in_tree) removeFromTree(object);
    if (object->instance != nullptr)
        object->extension->info.free_instance(object->extension->info.class_user, object->instance);
    if (object->parent != nullptr) std::erase(object->parent->children, object);
    const auto gone = objects_.extract(object->id);
}

void FakeEngine::addToTree(Object* node, Object* parent) {
    if (parent != nullptr) {
        node->parent = parent;
        parent->children.push_back(node);
    }
    constexpr int kEnterTree = 10, kReady = 13;
    node->is_in_tree = true;
    notify(node, kEnterTree);
    notify(node, kReady);
}

void FakeEngine::removeFromTree(Object* node) {
    constexpr int kExitTree = 11;
    for (Object* child : node->children)
        if (child->is_in_tree) removeFromTree(child);
    notify(node, kExitTree);
    node->is_in_tree = false;
}

void FakeEngine::notify(Object* node, int what) {
    if (node->instance != nullptr && node->extension->info.notification != nullptr)
        node->extension->info.notification(node->instance, what, 0);
}

void FakeEngine::frame(Object* node, double seconds) {
    constexpr int kInternalPhysicsProcess = 26;
    frame_seconds_ = seconds;
    notify(node, kInternalPhysicsProcess);
}

Any physicsDelta(FakeEngine& engine) { return engine.frame_seconds_; }

void FakeEngine::runOnRenderThread(const Any& callable) {
    if (!draws_on_own_thread) return callable.call();
    if (render_thread_ == nullptr) render_thread_ = std::make_unique<RenderThread>();
    render_thread_->post(callable);
}

RenderThread::RenderThread() : thread_([this] { work(); }) {}

RenderThread::~RenderThread() {
    post(Any());
    thread_.join();
}

void RenderThread::post(Any callable) {
    const std::scoped_lock lock(mutex_);
    jobs_.push_back(std::move(callable));
    has_come_.notify_one();
}

// Until it is given nothing.
void RenderThread::work() {
    while (true) {
        Any job;
        {
            std::unique_lock lock(mutex_);
            has_come_.wait(lock, [&] { return !jobs_.empty(); });
            job = jobs_.front();
            jobs_.pop_front();
        }
        if (job.isNull()) return;
        job.call();
    }
}

} // namespace godot_test
