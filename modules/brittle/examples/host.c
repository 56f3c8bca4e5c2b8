/* A host of its own Vulkan device: drops a glass cube on the ground, records its steps into a command buffer of its own, breaks
 * what is left by hand, and prints what broke and a hash. README.md of the project says how to build it. */
#include <brittle.h>
#include <stdio.h>
#include <stdlib.h>
#include <vulkan/vulkan.h>

#define COUNT(list) (uint32_t)(sizeof(list) / sizeof((list)[0]))

static BrittleContext* context;

static void mustBe(int good, const char* what) {
    if (good) return;
    fprintf(stderr, "%s failed\n", what);
    exit(EXIT_FAILURE);
}

static void must(BrittleResult result) {
    if (result == BRITTLE_OK) return;
    fprintf(stderr, "%s: %s\n", brittleResultName(result), context != NULL ? brittleLastError(context) : "see the log");
    exit(EXIT_FAILURE);
}

static void hear(void* user, BrittleLogLevel level, const char* message) {
    (void)user;
    fprintf(level == BRITTLE_LOG_ERROR ? stderr : stdout, "brittle: %s\n", message);
}

/* The first device there is, with shaderInt64 and nothing else; its first family has compute on every driver. */
static BrittleVulkan makeDevice(void) {
    const VkApplicationInfo app = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .apiVersion = VK_API_VERSION_1_1};
    const VkInstanceCreateInfo instance = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, .pApplicationInfo = &app};
    const VkPhysicalDeviceFeatures enabled = {.shaderInt64 = VK_TRUE};
    const float priority = 1;
    const VkDeviceQueueCreateInfo queue = {
        .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, .queueCount = 1, .pQueuePriorities = &priority};
    const VkDeviceCreateInfo device = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                       .queueCreateInfoCount = 1,
                                       .pQueueCreateInfos = &queue,
                                       .pEnabledFeatures = &enabled};
    BrittleVulkan vulkan = brittleDefaultContextDef().vulkan;
    uint32_t one = 1;
    mustBe(vkCreateInstance(&instance, NULL, &vulkan.instance) == VK_SUCCESS, "vkCreateInstance");
    mustBe(vkEnumeratePhysicalDevices(vulkan.instance, &one, &vulkan.physical_device) >= 0 && one == 1, "finding a device");
    mustBe(vkCreateDevice(vulkan.physical_device, &device, NULL, &vulkan.device) == VK_SUCCESS, "vkCreateDevice");
    vkGetDeviceQueue(vulkan.device, 0, 0, &vulkan.queue);
    vulkan.api_version = app.apiVersion;
    vulkan.features = BRITTLE_FEATURE_SHADER_INT64;
    return vulkan;
}

static BrittleWorld makeScene(void) {
    BrittleWorldDef world_def = brittleDefaultWorldDef();
    BrittleColliderDef ground = brittleDefaultColliderDef(); /* a plane, y = 0 */
    BrittleBodyDef cube = brittleDefaultBodyDef();
    BrittleWorld world;
    BrittleBody body;
    must(brittleFindMaterial(context, "glass", &cube.material));
    cube.shape.size = (BrittleVec3){0.2, 0.2, 0.2};
    cube.position.y = 1.5;
    cube.rotation = (BrittleQuat){0.3, 0.1, 0.2, 1};
    must(brittleCreateWorld(context, &world_def, &world));
    must(brittleAddBody(context, world, &cube, &body));
    must(brittleAddCollider(context, world, &ground, &body));
    must(brittleStartWorld(context, world));
    return world;
}

/* As an engine does in a frame: the steps are a part of its own commands. */
static void frame(const BrittleVulkan* vulkan, VkCommandPool pool, BrittleWorld world, uint32_t steps) {
    const VkCommandBufferAllocateInfo allocate = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, .commandPool = pool, .commandBufferCount = 1};
    const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    VkCommandBuffer commands;
    VkSubmitInfo submit = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &commands};
    mustBe(vkAllocateCommandBuffers(vulkan->device, &allocate, &commands) == VK_SUCCESS, "vkAllocateCommandBuffers");
    mustBe(vkBeginCommandBuffer(commands, &begin) == VK_SUCCESS, "vkBeginCommandBuffer");
    must(brittleRecordSteps(context, world, commands, steps));
    mustBe(vkEndCommandBuffer(commands) == VK_SUCCESS, "vkEndCommandBuffer");
    mustBe(vkQueueSubmit(vulkan->queue, 1, &submit, VK_NULL_HANDLE) == VK_SUCCESS, "vkQueueSubmit");
    mustBe(vkQueueWaitIdle(vulkan->queue) == VK_SUCCESS, "vkQueueWaitIdle");
    vkFreeCommandBuffers(vulkan->device, pool, 1, &commands);
    must(brittleFinishSteps(context, world));
}

static uint32_t tellBreaks(BrittleWorld world) {
    BrittleBreak breaks[16];
    uint32_t count = 0, broken = 0;
    must(brittleGetBreaks(context, world, breaks, COUNT(breaks), &count));
    for (uint32_t k = 0; k < count; k++) {
        const BrittleBreak* b = &breaks[k];
        printf("step %u: %s at %.2f m/s: ", b->step, b->hit_by.id != 0 ? "hit" : "struck by hand", b->speed);
        if (b->outcome == BRITTLE_BROKE)
            printf("%u fragments, %u cells too small for bodies, %.3f J of cracks\n", b->fragments, b->dust_cells, b->crack_energy);
        else
            printf("stays whole\n");
        broken += b->outcome == BRITTLE_BROKE;
    }
    return broken;
}

int main(void) {
    BrittleContextDef def = brittleDefaultContextDef();
    VkCommandPoolCreateInfo pool_info = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    VkCommandPool pool;
    uint32_t broken;
    uint64_t hash;
    BrittleVulkan vulkan = makeDevice();
    def.vulkan = vulkan;
    def.log = hear;
    must(brittleCreateContext(&def, &context));
    mustBe(vkCreateCommandPool(vulkan.device, &pool_info, NULL, &pool) == VK_SUCCESS, "vkCreateCommandPool");
    const BrittleWorld world = makeScene();
    frame(&vulkan, pool, world, 60);
    broken = tellBreaks(world);
    must(brittleDamage(context, world, (BrittleVec3){0, 0.1, 0}, 0.5, 2)); /* J, within half a meter */
    frame(&vulkan, pool, world, 60);
    broken += tellBreaks(world);
    must(brittleHashState(context, world, &hash));
    printf("%u broke; hash %016llx\n", broken, (unsigned long long)hash);
    brittleDestroyContext(context);
    vkDestroyCommandPool(vulkan.device, pool, NULL);
    vkDestroyDevice(vulkan.device, NULL);
    vkDestroyInstance(vulkan.instance, NULL);
    return broken > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
