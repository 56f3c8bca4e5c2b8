/* Brittle's C ABI: worlds of rigid bodies that break where they are hit, on Vulkan compute, for engines.
 *
 * Life of a host: make a context (on a Vulkan device of the host's, or on one that Brittle makes); make materials and meshes;
 * make a world and add bodies and colliders to it; start the world; from then on step it, or record its steps into the host's
 * command buffers; ask for what broke, draw from its buffers, damage by hand, save, restore, hash.
 * modules/brittle/examples/host.c does all of it in a hundred lines.
 *
 * UNITS are SI: meters, kilograms, seconds, joules, radians. Frames are right-handed; gravity is what the world says. Rotations
 * are quaternions x, y, z, w of any length from 1e-6 on.
 *
 * ERRORS. What can fail returns a BrittleResult; brittleLastError has, in words, what went wrong with the context's last call
 * that failed, and what to do. A call that fails leaves everything as it was, where nothing else is said. Any function that
 * takes a context may return BRITTLE_NULL_ARGUMENT (a pointer that must not be NULL is), BRITTLE_OUT_OF_MEMORY and
 * BRITTLE_INTERNAL (a bug of Brittle's, caught before it reached the host); one that takes an id BRITTLE_WRONG_HANDLE (never an
 * id of that kind and context) and BRITTLE_STALE_HANDLE (what it named is gone). Further errors stand with each function. No
 * exception leaves the library, and nothing in it ends the process. The pointer to a context is the one thing that cannot be
 * checked: it is good from brittleCreateContext to brittleDestroyContext.
 *
 * VERSIONS. Every struct that begins with `struct_size` is to be made by its brittleDefault... function (definitions) or to
 * have it set to sizeof (what is filled in for the host); another size is answered with BRITTLE_WRONG_VERSION. Structs do not
 * change within a SOVERSION of the library.
 *
 * OWNERSHIP. Definitions and all that they point at are read during the call and never afterwards. The host keeps its Vulkan
 * objects and destroys them after the context. Ids are values: nothing has to be freed but what has a brittleDestroy..., and a
 * context destroys all that is in it.
 *
 * THREADS. A context, and all in it, is used by one thread at a time, whichever; two contexts may be used by two threads at the
 * same time, also on one VkDevice. Brittle starts no thread that outlives a call. Functions marked [queue] submit to the
 * context's VkQueue and wait for it: Vulkan wants nobody else to use that queue meanwhile, so a host that uses it from other
 * threads gives lock_queue and unlock_queue. All others touch no queue. Callbacks are called on the thread that made the call,
 * during the call, and must not call back into the same context. Other queues of the device are never touched, and the device
 * as a whole is never waited for.
 */
#ifndef BRITTLE_H
#define BRITTLE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define BRITTLE_API __attribute__((visibility("default")))
#else
#define BRITTLE_API
#endif

#define BRITTLE_VERSION_MAJOR 0
#define BRITTLE_VERSION_MINOR 1
#define BRITTLE_VERSION_PATCH 0
/* Major in bits 22 to 31, minor in 12 to 21, patch in 0 to 11. */
#define BRITTLE_VERSION (((uint32_t)BRITTLE_VERSION_MAJOR << 22) | (BRITTLE_VERSION_MINOR << 12) | BRITTLE_VERSION_PATCH)

/* Vulkan's handles, as vulkan_core.h declares them, so that hosts without a device of their own need no Vulkan headers. */
typedef struct VkInstance_T* VkInstance;
typedef struct VkPhysicalDevice_T* VkPhysicalDevice;
typedef struct VkDevice_T* VkDevice;
typedef struct VkQueue_T* VkQueue;
typedef struct VkCommandBuffer_T* VkCommandBuffer;
typedef struct VkBuffer_T* VkBuffer;

typedef enum BrittleResult {
    BRITTLE_OK = 0,
    BRITTLE_NULL_ARGUMENT = 1, /* a pointer that must not be NULL is */
    BRITTLE_WRONG_VERSION = 2, /* header and library are of different versions, or a struct_size is wrong */
    BRITTLE_WRONG_HANDLE = 3,  /* never an id of this kind in this context or world */
    BRITTLE_STALE_HANDLE = 4,  /* what the id named has been destroyed, has broken or has gone */
    BRITTLE_BAD_VALUE = 5,     /* not a number, or out of range; brittleLastError names it */
    BRITTLE_BAD_MESH = 6,      /* open, not manifold, inside itself...; brittleLastError says what and where */
    BRITTLE_BAD_STATE = 7,     /* no saved state of such a world */
    BRITTLE_WRONG_ORDER = 8,   /* not now: before the start, after it, or with recorded steps unfinished */
    BRITTLE_CAPACITY = 9,      /* a budget or a limit of the device is too small; brittleLastError says which and by how much */
    BRITTLE_BUFFER_TOO_SMALL = 10, /* the host's; how much is needed has been written */
    BRITTLE_OUT_OF_MEMORY = 11,    /* of the host */
    BRITTLE_MISSING_FEATURE = 12,  /* the Vulkan device lacks it or was made without; brittleLastError names it */
    BRITTLE_DEVICE_FAILED = 13,    /* no Vulkan device, or one that failed */
    BRITTLE_INTERNAL = 14          /* a bug of Brittle's */
} BrittleResult;

typedef enum BrittleLogLevel { BRITTLE_LOG_INFO = 0, BRITTLE_LOG_WARNING = 1, BRITTLE_LOG_ERROR = 2 } BrittleLogLevel;

typedef struct BrittleContext BrittleContext;

/* Ids. All zeros is the id of nothing. An id of what is gone is never that of something else, within a context, its first 131,072
 * worlds and 16 million steps of one; but brittleRestoreState goes back in time: fragments that are made after it may have the ids of
 * fragments that were made before it, after the state was saved. Contexts draw by chance what tells their ids from those of others: a
 * world shares ids of bodies with one of another context once in 131,072, other ids are shared once in 16 million. */
typedef struct BrittleMesh {
    uint64_t id;
} BrittleMesh;
typedef struct BrittleMaterial {
    uint64_t id;
} BrittleMaterial;
typedef struct BrittleWorld {
    uint64_t id;
} BrittleWorld;
typedef struct BrittleBody {
    uint64_t id;
} BrittleBody; /* a body, a fragment or a collider; of one world */

typedef struct BrittleVec3 {
    double x, y, z;
} BrittleVec3;
/* What is handed over may have any length from 1e-6 on; each number from -1000 to 1000. */
typedef struct BrittleQuat {
    double x, y, z, w;
} BrittleQuat;

/* The version of the library: compare with BRITTLE_VERSION. Any thread, at any time. */
BRITTLE_API uint32_t brittleVersion(void);
/* "BRITTLE_OK" and so on; "BRITTLE_UNKNOWN_RESULT" for what is none. Never NULL; not to be freed. Any thread, at any time. */
BRITTLE_API const char* brittleResultName(BrittleResult result);

/* ---- Context
 * -------------------------------------------------------------------------------------------------------------------- */

/* Message: one line, in English, good during the call. */
typedef void (*BrittleLog)(void* user, BrittleLogLevel level, const char* message);

/* Aligned memory, or NULL where there is none left, which becomes BRITTLE_OUT_OF_MEMORY; `alignment` is a power of two. Through
 * it go the context itself, its tables of ids, and the records of meshes, materials, worlds and events that it keeps. What C++
 * containers hold inside of them and use while a function works, and what the Vulkan driver takes, does not: that comes from
 * the process's heap. */
typedef struct BrittleAllocator {
    void* (*allocate)(void* user, size_t size, size_t alignment);
    void (*release)(void* user, void* memory, size_t size, size_t alignment);
    void* user;
} BrittleAllocator;

typedef void (*BrittleVoidFunction)(void);
typedef BrittleVoidFunction (*BrittleGetProcAddress)(VkInstance instance, const char* name);

/* What a host's VkDevice was made with, which nobody can ask it. */
typedef enum BrittleDeviceFeature {
    BRITTLE_FEATURE_SHADER_INT64 = 1,    /* VkPhysicalDeviceFeatures::shaderInt64: the one that is needed */
    BRITTLE_FEATURE_SHADER_FLOAT64 = 2,  /* shaderFloat64; unused by worlds as yet */
    BRITTLE_FEATURE_PUSH_DESCRIPTOR = 4, /* VK_KHR_push_descriptor; without it descriptor sets are pooled */
    /* drawIndirectFirstInstance and multiDrawIndirect; only the host's own drawing asks for them. */
    BRITTLE_FEATURE_DRAW_INDIRECT_FIRST_INSTANCE = 8,
    BRITTLE_FEATURE_MULTI_DRAW_INDIRECT = 16
} BrittleDeviceFeature;

/* A device of the host's. Vulkan 1.1 (the instance made for it as well), a queue of a family with compute, 16 storage buffers a
 * stage and 128 bytes of push constants are needed. Neither synchronization2 nor scalar block layout nor any extension is. */
typedef struct BrittleVulkan {
    uint32_t struct_size;
    /* NULL: Brittle makes instance and device of its own, and device_name is all that counts of what follows. */
    VkInstance instance;
    VkPhysicalDevice physical_device;
    VkDevice device;
    VkQueue queue;
    uint32_t api_version; /* VkApplicationInfo::apiVersion that the instance was made for: at least VK_API_VERSION_1_1 */
    uint32_t queue_family;
    uint32_t features;                            /* BRITTLE_FEATURE_..., those that the device was made with */
    BrittleGetProcAddress get_instance_proc_addr; /* NULL: that of the machine's Vulkan loader */
    /* Called around every use of the queue; NULL, both, where only the context's thread uses it. */
    void (*lock_queue)(void* user);
    void (*unlock_queue)(void* user);
    void* queue_user;
    /* Of a device of its own: a part of its name, or its index; NULL: BRITTLE_DEVICE of the environment, else the best. */
    const char* device_name;
} BrittleVulkan;

typedef struct BrittleContextDef {
    uint32_t struct_size;
    uint32_t version; /* BRITTLE_VERSION of the header that the host was compiled with */
    BrittleVulkan vulkan;
    BrittleLog log; /* NULL: nobody listens */
    void* log_user;
    BrittleAllocator allocator; /* allocate and release NULL: the process's heap */
} BrittleContextDef;

/* A device of Brittle's own, no log, the process's heap. Any thread, at any time. */
BRITTLE_API BrittleContextDef brittleDefaultContextDef(void);

/* Makes a context; *context is NULL where that fails, and, there being no context to ask, the log hears why. Errors:
 * WRONG_VERSION (another major or minor version), BAD_VALUE (half of a pair of functions, handles missing, a family without
 * compute), MISSING_FEATURE, DEVICE_FAILED, CAPACITY. Any thread. */
BRITTLE_API BrittleResult brittleCreateContext(const BrittleContextDef* def, BrittleContext** context);
/* [queue] Waits for the queue and destroys all that is in it. Command buffers that steps or draws were recorded into must not
 * be submitted any more. NULL does nothing. */
BRITTLE_API void brittleDestroyContext(BrittleContext* context);
/* Of the context's last call that failed; "" where none has. Good until the next call that fails. Never NULL but for NULL. */
BRITTLE_API const char* brittleLastError(const BrittleContext* context);
/* What the context works on, for hosts that draw on a device that Brittle made; of such, `features` are those of the list above
 * that it has. Handles stay the context's. device_name is good as long as the context. struct_size has to be set. */
BRITTLE_API BrittleResult brittleGetVulkan(BrittleContext* context, BrittleVulkan* vulkan);

/* ---- Meshes
 * --------------------------------------------------------------------------------------------------------------------- */

/* A triangle mesh in memory. Corners that share a place are one vertex for breaking, whatever their normals. */
typedef struct BrittleMeshDef {
    uint32_t struct_size;
    uint32_t vertex_count;
    const float* positions;                             /* three a vertex, m */
    const float* normals;                               /* three a vertex, or NULL: those of the triangles */
    const float* uvs;                                   /* two a vertex, or NULL: 0 */
    uint32_t position_stride, normal_stride, uv_stride; /* bytes from one to the next; 0: tightly packed; else multiples of 4 */
    uint32_t index_count;                               /* a multiple of 3, at most 9,000,000 */
    const uint32_t* indices;                            /* counterclockwise seen from outside */
    uint32_t is_open; /* 0: it bounds a solid, is checked for that, and may be a body; 1: any triangles, for colliders only */
} BrittleMeshDef;

BRITTLE_API BrittleMeshDef brittleDefaultMeshDef(void);
/* Copies and checks. Errors: BAD_VALUE (counts, strides, an index beyond the vertices, what is no number), BAD_MESH. */
BRITTLE_API BrittleResult brittleCreateMesh(BrittleContext* context, const BrittleMeshDef* def, BrittleMesh* mesh);
/* Bodies that were made of it stay as they are. */
BRITTLE_API BrittleResult brittleDestroyMesh(BrittleContext* context, BrittleMesh mesh);

/* ---- Materials
 * ------------------------------------------------------------------------------------------------------------------ */

/* A card of numbers. What is 0 is as in the built-in material that `like` names: glass, porcelain, concrete, brick, ice, stone.
 */
typedef struct BrittleMaterialDef {
    uint32_t struct_size;
    const char* like;        /* "glass" by default */
    double density;          /* kg/m3, 1e-3 to 1e6 */
    double youngs_modulus;   /* Pa, 1 to 1e13 */
    double poisson_ratio;    /* up to 0.499 */
    double fracture_energy;  /* J/m2 of crack, 1e-6 to 1e9 */
    double tensile_strength; /* Pa, which 37 of 100 bodies of the reference volume have, 1 to 1e13 */
    double weibull_modulus;  /* 1 to 1000: how alike bodies are */
    double reference_volume; /* m3, 1e-12 to 1e6 */
    double eta;              /* up to 1: the share of a blow's energy that goes into cracks */
    double smallest_cell;    /* m, up to 1000 */
} BrittleMaterialDef;

BRITTLE_API BrittleMaterialDef brittleDefaultMaterialDef(void);
/* Errors: BAD_VALUE, for a name that is none (the message has those that there are) and numbers out of range. */
BRITTLE_API BrittleResult brittleCreateMaterial(BrittleContext* context, const BrittleMaterialDef* def,
                                                BrittleMaterial* material);
/* The built-in one of that name, as a material of this context like any other. Errors: BAD_VALUE. */
BRITTLE_API BrittleResult brittleFindMaterial(BrittleContext* context, const char* name, BrittleMaterial* material);
/* Bodies that were made of it stay as they are. */
BRITTLE_API BrittleResult brittleDestroyMaterial(BrittleContext* context, BrittleMaterial material);

/* ---- Worlds
 * --------------------------------------------------------------------------------------------------------------------- */

/* What a world does; what an effect needs comes along, and what is not asked for costs neither memory nor time. */
typedef enum BrittleEffect {
    BRITTLE_EFFECT_GRAVITY = 1 << 0,
    BRITTLE_EFFECT_CONTACTS = 1 << 1,
    BRITTLE_EFFECT_FRICTION = 1 << 2,
    BRITTLE_EFFECT_RESTITUTION = 1 << 3,
    BRITTLE_EFFECT_CCD = 1 << 4,             /* fast bodies do not pass through others */
    BRITTLE_EFFECT_SLEEPING = 1 << 5,        /* what has come to rest costs nothing */
    BRITTLE_EFFECT_IMPACT_FRACTURE = 1 << 6, /* bodies of a material break where they are hit */
    BRITTLE_EFFECT_REFRACTURE = 1 << 7,      /* so do their fragments */
    BRITTLE_EFFECT_DUST = 1 << 8,            /* what is too small for a body flies on as particles */
    BRITTLE_EFFECT_DEBRIS_LIFETIME = 1 << 9, /* small fragments at rest fade and go */
    BRITTLE_EFFECT_EVENTS = 1 << 10,         /* the host can ask what broke */
    BRITTLE_EFFECT_DRAG = 1 << 11,           /* air */
    BRITTLE_EFFECT_DEBRIS_ROOM = 1 << 12     /* where room for fragments runs short, the smallest and oldest at rest go */
} BrittleEffect;

/* Room. 0: chosen by what the world begins with; pairs and contacts then grow where they must. BAD_VALUE for more than 1e7, or 1e6
 * particles of dust; CAPACITY, by brittleStartWorld, for what the device cannot do. */
typedef struct BrittleBudget {
    uint32_t pairs; /* of convex pieces that are near each other */
    uint32_t contacts;
    uint32_t fragments; /* that there are at a time; 4 for each body that can break, from 1024 to 8192. A part of them is
                           kept for bodies that have not broken yet: where room runs short, bodies break into fewer */
    uint32_t fragment_faces;     /* of their colliders */
    uint32_t fragment_triangles; /* of their surfaces */
    uint32_t most_fragments;     /* of one body, no more than breaking_sites; 256 */
    uint32_t breaking_bodies;    /* that break in a step, at most 256; the others wait for the next; 16 */
    uint32_t breaking_sites;     /* of a step */
    uint32_t breaking_triangles; /* of their surfaces, in a step */
    uint32_t dust;               /* particles at a time */
} BrittleBudget;

typedef struct BrittleWorldDef {
    uint32_t struct_size;
    uint32_t effects; /* BRITTLE_EFFECT_... */
    BrittleVec3 gravity;   /* m/s2, each within 1e4 */
    double dt;             /* s, of a step: 1e-6 to 0.5 */
    uint32_t substeps;     /* of the solver, 1 to 64 */
    uint32_t iterations;   /* in each, 1 to 64 */
    uint64_t seed;         /* of how things break */
    double smallest_piece; /* m, up to 100: cells of less than the volume of such a cube are no bodies */
    double dust_lifetime;  /* s, up to 1e6 */
    double debris_below;   /* m, up to 1e3: fragments of less than the volume of such a cube fade, */
    double debris_after;   /* s, up to 1e6, after they have come to rest, */
    double debris_fade;    /* for so many s, up to 1e6 */
    double impact_speed;   /* m/s: what meets more slowly is no impact to tell of; 1e-3 to 1e4 */
    double air_density;    /* kg/m3, up to 1e4 */
    double drag_coefficient; /* up to 100 */
    BrittleBudget budget;
    uint32_t has_surfaces; /* 1: it can be drawn (brittleGetDrawBuffers, brittleGetSurface); 0 saves the memory for that */
} BrittleWorldDef;

/* Earth's gravity, 60 steps a second, 4 substeps; gravity, contacts, friction, ccd, sleeping, impact_fracture, refracture,
 * events, debris_room. */
BRITTLE_API BrittleWorldDef brittleDefaultWorldDef(void);
/* A world to be filled: see brittleStartWorld. Errors: BAD_VALUE. */
BRITTLE_API BrittleResult brittleCreateWorld(BrittleContext* context, const BrittleWorldDef* def, BrittleWorld* world);
/* [queue] Waits for the queue. Command buffers that its steps or draws were recorded into must not be submitted any more. */
BRITTLE_API BrittleResult brittleDestroyWorld(BrittleContext* context, BrittleWorld world);

typedef enum BrittleShapeKind {
    BRITTLE_SHAPE_BOX = 0,
    BRITTLE_SHAPE_BALL = 1,
    BRITTLE_SHAPE_HULL = 2, /* the convex hull of points */
    BRITTLE_SHAPE_MESH = 3,
    BRITTLE_SHAPE_PLANE = 4 /* colliders only: all below y = 0 of its frame */
} BrittleShapeKind;

typedef struct BrittleShape {
    uint32_t kind;        /* BRITTLE_SHAPE_... */
    BrittleVec3 size;     /* of a box: edges, m */
    double radius;        /* of a ball, m */
    uint32_t corners;     /* of a ball's hull, 4 to 34 */
    uint32_t point_count; /* of a hull: at least 4 that span a solid, at most 1,000,000 */
    const BrittleVec3* points;
    BrittleMesh mesh;
    /* Of a mesh that moves: convex cells that it collides by, 1 where it is convex, more the more it is not; they leave no gap;
     * to 4096. */
    uint32_t cells;
} BrittleShape;

/* How fragments lie: about the blow; evenly; in a plate in spokes and rings about the blow. */
typedef enum BrittlePattern {
    BRITTLE_PATTERN_IMPACT = 0,
    BRITTLE_PATTERN_UNIFORM = 1,
    BRITTLE_PATTERN_RADIAL = 2
} BrittlePattern;

typedef struct BrittleBodyDef {
    uint32_t struct_size;
    uint32_t is_fixed; /* 1: it does not move until it breaks; velocity and spin have to be 0 */
    BrittleShape shape;
    BrittleVec3 position;     /* of the shape's origin, within 1e6 m */
    BrittleQuat rotation;     /* of the shape's frame to the world */
    BrittleVec3 velocity;     /* m/s, at most 1e4 */
    BrittleVec3 spin;         /* rad/s, world axes */
    double density;           /* kg/m3; 0: its material's, without one 1000 */
    double mass;              /* kg, instead of a density; 0: by density */
    double friction;          /* 0.6 */
    double restitution;       /* 0 to 1; 0 */
    BrittleMaterial material; /* that it breaks as; all zeros: it does not break */
    uint32_t pattern;         /* BRITTLE_PATTERN_... */
} BrittleBodyDef;

typedef struct BrittleColliderDef {
    uint32_t struct_size;
    BrittleShape shape; /* a plane by default; a mesh is its triangles, each with two sides, and need not be closed */
    BrittleVec3 position;
    BrittleQuat rotation;
    double friction;
    double restitution;
} BrittleColliderDef;

/* A cube of 1 m, of no material. */
BRITTLE_API BrittleBodyDef brittleDefaultBodyDef(void);
BRITTLE_API BrittleColliderDef brittleDefaultColliderDef(void);
/* Before the start. Errors: WRONG_ORDER after it; BAD_VALUE; BAD_MESH for an open mesh; WRONG_HANDLE and STALE_HANDLE of mesh
 * and material as well; CAPACITY for a mesh that breaks and has more triangles than the device has room for. */
BRITTLE_API BrittleResult brittleAddBody(BrittleContext* context, BrittleWorld world, const BrittleBodyDef* def,
                                         BrittleBody* body);
BRITTLE_API BrittleResult brittleAddCollider(BrittleContext* context, BrittleWorld world, const BrittleColliderDef* def,
                                             BrittleBody* collider);

/* [queue] Makes all of it on the device: takes tenths of a second, and longer where meshes are cut into cells or nothing is in
 * the driver's cache yet. What it has is frozen then, but for what breaks. Errors: WRONG_ORDER for a second start; BAD_VALUE
 * for a world without a body; CAPACITY; DEVICE_FAILED. */
BRITTLE_API BrittleResult brittleStartWorld(BrittleContext* context, BrittleWorld world);

/* ---- Stepping
 * -------------------------------------------------------------------------------------------------------------------- */

/* All of these: WRONG_ORDER before the start; of all but the recording ones also while recorded steps are unfinished. */

/* [queue] Makes so many steps and waits: 0 to 1,000,000. Errors: CAPACITY where a budget that was given is too small: the steps
 * from that one on have not been made; BAD_VALUE, once, where the motion of a body outgrew its numbers: it was stopped. */
BRITTLE_API BrittleResult brittleStep(BrittleContext* context, BrittleWorld world, uint32_t steps);
/* [queue] Raises the budgets of pairs and contacts of a running world; 0: room is made as it is needed. A step that failed for want of
 * them can be made after that. The state stays as it is. Buffers for drawing are other ones then (`generation`). Errors: BAD_VALUE
 * for less than there is room for, CAPACITY for what the device cannot do: the budgets stay as they were. */
BRITTLE_API BrittleResult brittleSetBudget(BrittleContext* context, BrittleWorld world, uint32_t pairs, uint32_t contacts);

/* Records so many steps, 1 to 1000, into a primary command buffer of the host's that is being recorded, from a pool of the
 * context's queue family, outside of render passes. They come after all that was submitted or recorded before and before all
 * that is after. The command buffer is submitted once, to the context's queue, and several of them in the order in which they
 * were recorded into. */
BRITTLE_API BrittleResult brittleRecordSteps(BrittleContext* context, BrittleWorld world, VkCommandBuffer commands,
                                             uint32_t steps);
/* [queue] Once the device has finished with all command buffers that steps were recorded into: looks what became of them. Steps
 * that had too little room, and steps that were recorded and not submitted, are made now, where that can be. Where nothing was
 * recorded it does nothing. Errors: as brittleStep. */
BRITTLE_API BrittleResult brittleFinishSteps(BrittleContext* context, BrittleWorld world);

/* A blow by hand, in the next step that is made or recorded. Bodies of a material that are not further from `point` (world,
 * within 1e6 m) than `radius` (m, above 0, at most 1e6) share `energy` (J, above 0, at most 1e15) evenly; each is judged as in
 * every blow: as if a ball of that radius, as dense as the body and unyielding, had met it at its nearest place with that
 * energy. So a small radius takes little energy to break something, and a large one more; too little breaks nothing. Fragments
 * are smallest within `radius`. It pushes nothing. Bodies that a step has no room for (breaking_bodies, breaking_sites) break in
 * the steps after, where they were hit. At most 32 a step. The first call for a world makes buffers and records its steps anew.
 * Errors: BAD_VALUE, also if nothing in the world can break; CAPACITY; DEVICE_FAILED. Allowed while recorded steps are
 * unfinished. */
BRITTLE_API BrittleResult brittleDamage(BrittleContext* context, BrittleWorld world, BrittleVec3 point, double radius,
                                        double energy);

/* ---- What there is, and what happened
 * ------------------------------------------------------------------------------------------- */

typedef struct BrittleBodyState {
    BrittleBody body;
    BrittleBody origin;   /* the first body that a fragment was a part of, however often that broke; else the body itself */
    BrittleVec3 position; /* of the center of mass */
    BrittleQuat rotation; /* unit; of the frame that brittleGetSurface's vertices are in */
    BrittleVec3
        shape_position; /* of a body or collider, of the frame that its shape was given in; of a fragment as the two above */
    BrittleQuat shape_rotation;
    BrittleVec3 velocity; /* m/s, of the center of mass, half a substep before: what falls has g h / 2 more */
    BrittleVec3 spin;     /* world axes */
    double mass;          /* kg; 0 for what does not move */
    double left;          /* 1; of debris that fades less, down to 0 */
    uint32_t is_asleep;
    uint32_t is_fragment;
    uint32_t is_collider;
    uint32_t made_in_step; /* of a fragment, counted from 1 */
} BrittleBodyState;

typedef enum BrittleOutcome {
    BRITTLE_BROKE = 0,
    BRITTLE_WHOLE_NO_ROOM = 1,   /* hit hard enough, but the budget for fragments is used up */
    BRITTLE_WHOLE_TOO_DEAR = 2,  /* its cells have more faces between them than the blow could pay for */
    BRITTLE_WHOLE_ONE_PIECE = 3, /* all of it is one cell's */
    BRITTLE_WHOLE_FAILED = 4,    /* the budget of a step was too small, or the cut met what it cannot cut */
    BRITTLE_WHOLE_TOO_LARGE = 5, /* no step has room for it: it never breaks */
    BRITTLE_WHOLE_NO_PAIRS = 6,  /* budgets of pairs or contacts have no room for what its fragments are expected to have */
    BRITTLE_GONE = 7             /* it did not break: a fragment left the world, by debris_lifetime or debris_room; `position` is
                                    its center of mass, and what tells of a blow is 0 */
} BrittleOutcome;

/* A body that broke, or would have; or a fragment that left the world. */
typedef struct BrittleBreak {
    BrittleBody body;      /* stale from then on, if it broke */
    BrittleBody hit_by;    /* all zeros: brittleDamage */
    uint32_t step;         /* counted from 1 */
    uint32_t outcome;      /* BRITTLE_BROKE... */
    uint32_t fragments;    /* bodies that it became */
    uint32_t dust_cells;   /* cells too small for that */
    double dust_mass;      /* kg of them */
    BrittleVec3 position;  /* of the blow, world */
    BrittleVec3 normal;    /* from the body to what hit it, unit */
    double speed;          /* m/s along it */
    double effective_mass; /* kg, of the two there */
    double energy_before;  /* J, of the motion of both that met, */
    double energy_after;   /* and after the cracks were paid for */
    double crack_energy; /* J; of two that break each other the first tells what both have paid, and the other 0 of all three */
    double crack_area;   /* m2, of this body's cracks */
    double largest_mass; /* kg, of its fragments, */
    double smallest_mass;     /* and of the smallest that is a body */
    BrittleBody origin;       /* what was added and `body` is a part of: `body` itself, if it is no fragment */
    BrittleMaterial material; /* of all of it */
    BrittleBudget lacked; /* of one that stayed whole for want of room: how much more of what there should have been, else 0 */
} BrittleBreak;

/* Two bodies that met and did not break of it. */
typedef struct BrittleImpact {
    BrittleBody bodies[2];
    BrittleBody origins[2];       /* what was added and they are parts of: themselves, if they are no fragments */
    BrittleMaterial materials[2]; /* all zeros: of none */
    uint32_t step;                /* counted from 1 */
    uint32_t points;              /* of their contact that were hit, 1 to 4 */
    BrittleVec3 position;         /* of their middle, world */
    BrittleVec3 normal;           /* from the first body to the second, unit */
    double effective_mass;        /* kg, of the two there */
    double speed;                 /* m/s along the normal */
    double energy;                /* J, of that mass at that speed */
    double impulse;               /* N s that have changed that speed, bouncing and all */
} BrittleImpact;

typedef struct BrittleCounts {
    uint32_t struct_size;
    uint32_t bodies; /* slots of bodies, colliders and fragments that have ever held one */
    uint32_t awake;  /* bodies that moved and did not sleep in the last step; what left the world in it counts */
    uint32_t pairs, contacts;
    uint32_t broken;       /* bodies since the beginning */
    uint32_t fragments;    /* that they became; some may have broken again */
    uint32_t expired;      /* fragments that have gone, after their time or to make room */
    uint32_t breaks_lost;  /* events so far that came to nobody: the device keeps the last 1024 that were not asked for, also by brittleGetCounts,
                              the library 65,536 */
    uint32_t impacts_lost; /* likewise */
} BrittleCounts;

/* [queue] All bodies, fragments and colliders that there are, in the order of their slots. Writes up to `capacity` of them and
 * *count, all there are; where these are more: BUFFER_TOO_SMALL, and the first ones stand. `states` may be NULL where capacity
 * is 0. */
BRITTLE_API BrittleResult brittleGetBodies(BrittleContext* context, BrittleWorld world, BrittleBodyState* states,
                                           uint32_t capacity, uint32_t* count);
/* [queue] The same of one. Errors: STALE_HANDLE for a body that has broken or a fragment that is gone. */
BRITTLE_API BrittleResult brittleGetBody(BrittleContext* context, BrittleWorld world, BrittleBody body,
                                         BrittleBodyState* state);
/* [queue] With the effect `events`: what broke since this was last asked, the oldest first, each told once. Writes up to
 * `capacity` and *count, how many were written; what is left is told by the next call. `breaks` may be NULL where capacity is
 * 0. */
BRITTLE_API BrittleResult brittleGetBreaks(BrittleContext* context, BrittleWorld world, BrittleBreak* breaks, uint32_t capacity,
                                           uint32_t* count);
/* [queue] The same for what was hit, of each step the hardest 256. */
BRITTLE_API BrittleResult brittleGetImpacts(BrittleContext* context, BrittleWorld world, BrittleImpact* impacts,
                                            uint32_t capacity, uint32_t* count);
/* [queue] Of the last step. struct_size has to be set. */
BRITTLE_API BrittleResult brittleGetCounts(BrittleContext* context, BrittleWorld world, BrittleCounts* counts);

/* ---- Drawing
 * -------------------------------------------------------------------------------------------------------------------- */

/* All of these: BAD_VALUE where the world has no surfaces. */

typedef struct BrittleVertex {
    float position[3], normal[3], uv[2];
} BrittleVertex;

/* Of a slot of a body: what shaders may want to know. std430, 16 bytes. */
typedef struct BrittleDrawnBody {
    uint32_t body; /* the number that brittleNumberOf gives of it */
    uint32_t made_in_step;
    uint32_t origin; /* the number of the first body that it was a part of */
    float left;      /* 1; of debris that fades less, down to 0; the matrix shrinks it as much */
} BrittleDrawnBody;

/* One vkCmdDrawIndexedIndirect(commands, draw_buffer, draw_offset, draw_count, draw_stride) draws all of it, with a triangle
 * list, counterclockwise front faces, the vertices of BrittleVertex at binding 0 and indices of 32 bits. Draws come in twos, a
 * surface and the faces of cuts in it; slot = gl_InstanceIndex / 2, faces of cuts where it is odd. What is not there has no
 * instances. Buffers are the context's, of the queue's family, exclusive; they may be bound as the name says, as storage and as
 * source of copies, and must not be written. A world that has made more room for pairs has other buffers, and those before are
 * gone: look at `generation` after brittleStep, brittleFinishSteps, brittleRestoreState and whatever else asks the device, or
 * give BrittleBudget::pairs, and it never does. */
typedef struct BrittleDrawBuffers {
    uint32_t struct_size;
    uint32_t generation;
    VkBuffer vertex_buffer, index_buffer, draw_buffer;
    VkBuffer matrix_buffer; /* storage: a mat4 a slot, columns, of vertices to the world less the origin */
    VkBuffer body_buffer;   /* storage: a BrittleDrawnBody a slot */
    uint64_t vertex_offset, index_offset, draw_offset, matrix_offset, body_offset;
    uint64_t vertex_bytes, index_bytes, draw_bytes, matrix_bytes, body_bytes;
    uint32_t draw_count;  /* two a slot */
    uint32_t draw_stride; /* bytes */
} BrittleDrawBuffers;

/* [queue] struct_size has to be set. Contents are those of the last brittleRecordDraws or brittleUpdateDraws. Errors: CAPACITY.
 */
BRITTLE_API BrittleResult brittleGetDrawBuffers(BrittleContext* context, BrittleWorld world, BrittleDrawBuffers* buffers);
/* Records, as brittleRecordSteps does, the writing of draws and matrices of the bodies as they are then; places count from
 * `origin` (world, within 1e6 m), so that what is far from the world's origin is drawn as finely. Call brittleGetDrawBuffers
 * first: WRONG_ORDER else. */
BRITTLE_API BrittleResult brittleRecordDraws(BrittleContext* context, BrittleWorld world, VkCommandBuffer commands,
                                             BrittleVec3 origin);
/* [queue] The same, submitted and waited for. */
BRITTLE_API BrittleResult brittleUpdateDraws(BrittleContext* context, BrittleWorld world, BrittleVec3 origin);
/* What BrittleDrawnBody has of a body or a fragment: the number of its slot, also of a fragment that is gone or never was, since this
 * touches no device. Errors: WRONG_HANDLE. */
BRITTLE_API BrittleResult brittleNumberOf(BrittleContext* context, BrittleWorld world, BrittleBody body, uint32_t* number);

/* [queue] The surface of one body or fragment in memory: three vertices a triangle, about its center of mass, in the frame of
 * BrittleBodyState::rotation; the first *outer of *count are its own surface, the others faces of cuts. A plane is a square
 * about the middle of what began above it. Writes up to `capacity` vertices; where there are more: BUFFER_TOO_SMALL. `vertices`
 * may be NULL where capacity is 0. */
BRITTLE_API BrittleResult brittleGetSurface(BrittleContext* context, BrittleWorld world, BrittleBody body,
                                            BrittleVertex* vertices, uint32_t capacity, uint32_t* count, uint32_t* outer);
/* [queue] Those of several, in one reading of the device, as after a break: the vertices of all, in the order of `bodies`, of
 * body k counts[k] with outers[k] of its own surface first; *total of them. `counts` and `outers` have room for `body_count`
 * numbers, and are written, as *total is, where the vertices are too many for `capacity`: BUFFER_TOO_SMALL. The lists may be
 * NULL where body_count is 0. Errors: those of brittleGetSurface of any of them, and nothing is written then. */
BRITTLE_API BrittleResult brittleGetSurfaces(BrittleContext* context, BrittleWorld world, const BrittleBody* bodies,
                                             uint32_t body_count, BrittleVertex* vertices, uint32_t capacity, uint32_t* total,
                                             uint32_t* counts, uint32_t* outers);

/* ---- State
 * ---------------------------------------------------------------------------------------------------------------------- */

/* [queue] All that the next step depends on, but for blows by hand that wait for it. *size: how many bytes it has; with `bytes`
 * NULL nothing else is written. Errors: BUFFER_TOO_SMALL. */
BRITTLE_API BrittleResult brittleSaveState(BrittleContext* context, BrittleWorld world, void* bytes, size_t capacity,
                                           size_t* size);
/* [queue] Into a world that was made of the same definitions in the same order, which is for the host to see to: worlds of other
 * sizes and lists are refused, but not such that differ in numbers only, as in gravity or a seed. Blows that wait for a step and events not yet
 * told are forgotten. What follows is, bit for bit, what followed then. Errors: BAD_STATE, CAPACITY. */
BRITTLE_API BrittleResult brittleRestoreState(BrittleContext* context, BrittleWorld world, const void* bytes, size_t size);
/* [queue] Of the motion of all bodies: equal for equal histories on one device. */
BRITTLE_API BrittleResult brittleHashState(BrittleContext* context, BrittleWorld world, uint64_t* hash);

#ifdef __cplusplus
}
#endif

#endif
