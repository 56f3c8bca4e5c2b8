#include "modules/brittle/abi/boundary.h"

#include <algorithm>
#include <cstdio>
#include <random>

namespace {

using namespace brittle::abi;

// By chance, so that ids of one context are none of another, though it may lie at the same place.
uint64_t drawnTag(const void* context) {
    uint64_t bits = reinterpret_cast<uintptr_t>(context) >> 4;
    std::random_device random;
    for (int k = 0; k < 2; ++k)
        bits = (bits ^ random()) * 0x9e3779b97f4a7c15u;
    return bits >> 32;
}

// In one line, whatever the names hold that hosts have given.
template <size_t N>
void write(std::array<char, N>& line, const char* message) noexcept {
    std::snprintf(line.data(), line.size(), "%s", message);
    for (char* c = line.data(); *c != '\0'; ++c)
        if (static_cast<unsigned char>(*c) < 0x20 || *c == 0x7f) *c = ' ';
}

void tell(BrittleLog log, void* user, BrittleLogLevel level, const char* message) noexcept {
    try {
        std::array<char, 1024> line;
        write(line, message);
        if (log != nullptr) log(user, level, line.data());
    } catch (...) { // a host of C++ that throws is not ours to end
    }
}

engine::ForeignDevice foreignOf(const BrittleVulkan& v) {
    const auto has = [&](BrittleDeviceFeature feature) { return (v.features & feature) != 0; };
    engine::ForeignDevice foreign;
    foreign.get_proc_addr = reinterpret_cast<PFN_vkGetInstanceProcAddr>(v.get_instance_proc_addr);
    foreign.instance = v.instance;
    foreign.api_version = v.api_version;
    foreign.physical = v.physical_device;
    foreign.device = v.device;
    foreign.queue = v.queue;
    foreign.family = v.queue_family;
    foreign.long_integers = has(BRITTLE_FEATURE_SHADER_INT64);
    foreign.enabled.push_descriptors = has(BRITTLE_FEATURE_PUSH_DESCRIPTOR);
    foreign.enabled.doubles = has(BRITTLE_FEATURE_SHADER_FLOAT64);
    foreign.enabled.multi_draw_indirect = has(BRITTLE_FEATURE_MULTI_DRAW_INDIRECT);
    foreign.enabled.draw_indirect_first_instance = has(BRITTLE_FEATURE_DRAW_INDIRECT_FIRST_INSTANCE);
    foreign.lock = v.lock_queue;
    foreign.unlock = v.unlock_queue;
    foreign.user = v.queue_user;
    return foreign;
}

uint32_t featuresOf(const engine::Device& device) {
    const engine::OptionalFeatures& has = device.features();
    uint32_t features = BRITTLE_FEATURE_SHADER_INT64;
    if (has.doubles) features |= BRITTLE_FEATURE_SHADER_FLOAT64;
    if (has.push_descriptors) features |= BRITTLE_FEATURE_PUSH_DESCRIPTOR;
    if (has.draw_indirect_first_instance) features |= BRITTLE_FEATURE_DRAW_INDIRECT_FIRST_INSTANCE;
    if (has.multi_draw_indirect) features |= BRITTLE_FEATURE_MULTI_DRAW_INDIRECT;
    return features;
}

std::unique_ptr<engine::Device> deviceOf(const BrittleVulkan& v) {
    if (v.instance != nullptr) return orRefuse(engine::Device::adopt(foreignOf(v)));
    if (v.device != nullptr)
        throw Refusal(BRITTLE_BAD_VALUE, "a VkDevice without its VkInstance; give all four of Vulkan's handles, or none");
    return orRefuse(engine::Device::create({.select = v.device_name != nullptr ? v.device_name : ""}));
}

void checkDef(const BrittleContextDef& def) {
    constexpr uint32_t kPatchBits = 12;
    if (def.version >> kPatchBits != BRITTLE_VERSION >> kPatchBits)
        throw Refusal(BRITTLE_WRONG_VERSION, "the host was compiled with another version of brittle.h than the library is of");
    if (def.vulkan.struct_size != sizeof def.vulkan)
        throw Refusal(BRITTLE_WRONG_VERSION, "'vulkan' has another struct_size; begin with brittleDefaultContextDef");
    if ((def.allocator.allocate == nullptr) != (def.allocator.release == nullptr))
        throw Refusal(BRITTLE_BAD_VALUE, "an allocator allocates and releases: give both functions or neither");
    if ((def.vulkan.lock_queue == nullptr) != (def.vulkan.unlock_queue == nullptr))
        throw Refusal(BRITTLE_BAD_VALUE, "what locks a queue unlocks it: give 'lock_queue' and 'unlock_queue' or neither");
}

BrittleContext* makeContext(const BrittleContextDef& def) {
    auto device = deviceOf(def.vulkan);
    HostMemory memory(def.allocator);
    void* place = memory.allocate(sizeof(BrittleContext), alignof(BrittleContext));
    try {
        return new (place) BrittleContext(def, std::move(device));
    } catch (...) {
        memory.deallocate(place, sizeof(BrittleContext), alignof(BrittleContext));
        throw;
    }
}

} // namespace

BrittleContext::BrittleContext(const BrittleContextDef& def, std::unique_ptr<engine::Device> opened)
    : memory(def.allocator), log(def.log), log_user(def.log_user), device(std::move(opened)), tag(drawnTag(this)),
      meshes(Kind::Mesh, tag, &memory), materials(Kind::Material, tag, &memory), worlds(Kind::World, tag, &memory),
      next_world(tag) {}

BrittleContext::~BrittleContext() {
    device->waitIdle();
    worlds.clear();
}

BrittleResult BrittleContext::fail(BrittleResult code, const char* message) noexcept {
    write(last_error, message);
    tell(log, log_user, BRITTLE_LOG_ERROR, last_error.data());
    return code;
}

BrittleResult brittleCreateContext(const BrittleContextDef* def, BrittleContext** context) {
    if (context == nullptr) return BRITTLE_NULL_ARGUMENT;
    *context = nullptr;
    if (def == nullptr) return BRITTLE_NULL_ARGUMENT;
    if (def->struct_size != sizeof *def) return BRITTLE_WRONG_VERSION; // nothing in it can be believed, the log neither
    return caught(
        [&] {
            checkDef(*def);
            *context = makeContext(*def);
            tell(def->log, def->log_user, BRITTLE_LOG_INFO, ("works on " + (*context)->device->name()).c_str());
        },
        [&](BrittleResult code, const char* message) {
            tell(def->log, def->log_user, BRITTLE_LOG_ERROR, message);
            return code;
        });
}

void brittleDestroyContext(BrittleContext* context) {
    if (context == nullptr) return;
    const auto destroyed = caught(
        [&] {
            HostMemory memory = context->memory;
            context->~BrittleContext();
            memory.deallocate(context, sizeof *context, alignof(BrittleContext));
        },
        [](BrittleResult code, const char*) { return code; });
    static_cast<void>(destroyed);
}

const char* brittleLastError(const BrittleContext* context) {
    return context == nullptr ? nullptr : context->last_error.data();
}

BrittleResult brittleGetVulkan(BrittleContext* context, BrittleVulkan* vulkan) {
    return bounded(context, [&](BrittleContext& c) {
        BrittleVulkan& out = sized(vulkan, "vulkan");
        const engine::Device& device = *c.device;
        out = {};
        out.struct_size = sizeof out;
        out.instance = device.instanceHandle();
        out.physical_device = device.physical();
        out.device = device.handle();
        out.queue = device.computeQueue().handle;
        out.queue_family = device.computeQueue().family;
        out.api_version = device.instanceVersion();
        out.features = featuresOf(device);
        out.device_name = device.name().c_str();
    });
}
