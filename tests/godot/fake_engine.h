// An engine as the plugin sees it: it loads the plugin, keeps its classes, makes objects of them, and has as much of nodes,
// meshes and of the rendering server as the plugin asks for. Whatever the plugin asks for that is not of the right class,
// number or type is a complaint.
#pragma once

#include "tests/godot/fake_variant.h"

#include <condition_variable>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

namespace godot_test {

struct ExtensionClass;

struct Object {
    uint64_t id = 0;
    std::string class_name;
    ExtensionClass* extension = nullptr; // of those that the plugin has announced
    void* instance = nullptr;
    void* binding = nullptr;
    int references = 0;
    Object* parent = nullptr;
    std::vector<Object*> children;
    bool is_in_tree = false;
    std::map<std::string, Any> fields;
};

struct Announced {
    std::string name, class_name, hint_string;
    Type type = Type::Nil;
    uint32_t hint = 0;
};
struct AnnouncedMethod {
    brittle_godot::MethodInfo info = {};
    std::vector<Announced> arguments;
    Announced result;
};
struct AnnouncedProperty : Announced {
    std::string setter, getter;
};
struct ExtensionClass {
    std::string name, parent;
    brittle_godot::ClassInfo info = {};
    std::map<std::string, AnnouncedMethod> methods;
    std::map<std::string, AnnouncedProperty> properties;
    std::map<std::string, std::vector<Announced>> signals;
    std::map<std::string, int64_t> constants;
};

struct Called {
    Any result;
    brittle_godot::CallError error = {};
};

struct Emission {
    uint64_t object = 0;
    std::string name;
    std::vector<Any> arguments;
};

struct Instance3d { // of the rendering server's
    std::array<float, 12> transform = {};
    bool is_visible = true;
    int64_t layers = 1, shadows = 1;
};

// Calls what it is given, one after the other.
class RenderThread {
public:
    RenderThread();
    ~RenderThread();
    RenderThread(const RenderThread&) = delete;
    RenderThread& operator=(const RenderThread&) = delete;
    void post(Any callable);
    std::thread::id id() const { return thread_.get_id(); }

private:
    void work();
    std::mutex mutex_;
    std::condition_variable has_come_;
    std::deque<Any> jobs_;
    std::thread thread_;
};

class FakeEngine {
public:
    FakeEngine();
    ~FakeEngine(); // frees all objects; the plugin has to be gone
    FakeEngine(const FakeEngine&) = delete;
    FakeEngine& operator=(const FakeEngine&) = delete;

    // How it is, before the plugin is loaded or a world starts.
    std::string lacks_function, lacks_method; // of the C interface; of a class
    bool is_editor = false, makes_nothing = false;
    std::string driver = "vulkan";
    std::vector<uint64_t> driver_resources; // as get_driver_resource numbers them; empty: it draws without a device
    bool draws_on_own_thread = false;

    // False where the plugin refuses.
    bool load();
    void unload();
    std::map<std::string, std::unique_ptr<ExtensionClass>> classes;

    Object* make(const std::string& class_name); // of the engine's or of the plugin's; NULL: cannot be made
    void free(Object* object);
    size_t objectCount() const { return objects_.size(); }
    void addToTree(Object* node, Object* parent = nullptr); // NULL: at the root
    void removeFromTree(Object* node);
    void notify(Object* node, int what);
    void frame(Object* node, double seconds); // a physics frame of it

    // As a script does: by Variants. And as compiled scripts do: by plain values.
    Called call(Object* object, const std::string& method, const std::vector<Any>& arguments = {});
    Any get(Object* object, const std::string& property);
    void set(Object* object, const std::string& property, const Any& value);

    std::vector<Emission> emissions;
    std::function<void(const Emission&)> listener;
    std::vector<std::string> errors, warnings;
    std::map<uint64_t, Instance3d> instances;
    bool isOnRenderThread() const { return render_thread_ == nullptr || std::this_thread::get_id() == render_thread_->id(); }

    // For the functions of the C interface:
    Called callMethod(Object* object, const std::string& method, const std::vector<Any>& arguments);
    Object* find(uint64_t id) const;
    Object* singleton(const std::string& name);
    bool isA(const Object& object, const std::string& class_name) const;
    uint64_t nextId() { return ++last_id_; }
    void runOnRenderThread(const Any& callable);

private:
    std::map<uint64_t, std::unique_ptr<Object>> objects_;
    std::map<std::string, Object*> singletons_;
    brittle_godot::Initialization plugin_ = {};
    uint64_t last_id_ = 1000;
    double frame_seconds_ = 0;
    std::unique_ptr<RenderThread> render_thread_;
    friend Any physicsDelta(FakeEngine& engine);
};

FakeEngine& engine(); // the one there is

// A method of the engine's own classes.
struct EngineMethod {
    std::vector<Type> arguments;
    std::function<Any(FakeEngine&, Object&, const std::vector<Any>&)> body;
};
// By "Class.method".
const std::map<std::string, EngineMethod>& engineMethods();
// "" above Object.
std::string parentOf(const std::string& class_name);

// Box and others of the engine's meshes, as an ArrayMesh whose front faces are clockwise.
Object* boxMesh(FakeEngine& engine, float x, float y, float z);

} // namespace godot_test
