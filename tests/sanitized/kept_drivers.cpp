// Drivers keep some memory until the process ends, and are unloaded with the last instance that uses them. At exit the leak
// checker could then not name who holds that memory, nor lsan.supp suppress it: one instance, of the program's own, keeps them.
#include <dlfcn.h>
#include <vulkan/vulkan_core.h>

namespace {

VkInstance keepDrivers() {
    void* loader = dlopen("libvulkan.so.1", RTLD_NOW);
    if (loader == nullptr) return VK_NULL_HANDLE;
    const auto create = reinterpret_cast<PFN_vkCreateInstance>(dlsym(loader, "vkCreateInstance"));
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    VkInstance instance = VK_NULL_HANDLE;
    if (create != nullptr) create(&info, nullptr, &instance);
    return instance;
}

const VkInstance kept_drivers = keepDrivers();

} // namespace
