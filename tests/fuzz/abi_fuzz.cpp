// Fuzzes the C ABI: bytes are calls, in any order, with numbers, ids and pointers good and bad. The context lives on a device
// of its own for as long as the program; meshes, materials and worlds come and go. Worlds are started and stepped seldom, and
// only such as nothing breaks in: a driver's compiler takes longer than thousands of other calls.
#include "modules/brittle/brittle.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace {

// Numbers that code stumbles over, among ordinary ones.
constexpr double kNumbers[] = {0, -0.0, 1, -1, 0.5, 2, 1e-300, 1e300, 1e6, -1e6, 9.81, 0.01, 3e38, 1e-30};

class Input {
public:
    Input(const uint8_t* data, size_t size) : data_(data), size_(size) {}
    bool isOver() const { return size_ == 0; }
    uint8_t byte() {
        if (size_ == 0) return 0;
        --size_;
        return *data_++;
    }
    template <class T>
    T raw() {
        T value = {};
        const size_t bytes = size_ < sizeof value ? size_ : sizeof value;
        std::memcpy(&value, data_, bytes);
        data_ += bytes;
        size_ -= bytes;
        return value;
    }
    double number() {
        const uint8_t which = byte();
        if (which < 160) return kNumbers[which % std::size(kNumbers)];
        return which < 250 ? 0.05 * which : raw<double>(); // also NaN and infinities
    }
    uint32_t count() { return byte() < 250 ? byte() % 40u : raw<uint32_t>(); }
    BrittleVec3 vector() { return {number(), number(), number()}; }
    BrittleQuat quat() { return {number(), number(), number(), number()}; }

private:
    const uint8_t* data_;
    size_t size_;
};

struct Player {
    explicit Player(BrittleContext* c) : context(c) {}
    ~Player() {
        for (const BrittleWorld world : worlds)
            brittleDestroyWorld(context, world);
        for (const BrittleMesh mesh : meshes)
            brittleDestroyMesh(context, mesh);
        for (const BrittleMaterial material : materials)
            brittleDestroyMaterial(context, material);
    }
    Player(const Player&) = delete;
    Player& operator=(const Player&) = delete;

    // One that there is, or was, or bits.
    template <class Id>
    Id pick(Input& in, const std::vector<Id>& known) {
        const uint8_t which = in.byte();
        if (known.empty() || which > 230) return {in.raw<uint64_t>()};
        return known[which % known.size()];
    }
    template <class T>
    T* maybe(Input& in, T& value) {
        return in.byte() < 4 ? nullptr : &value;
    }

    void play(Input& in);
    void addMesh(Input& in);
    void addMaterial(Input& in);
    void addWorld(Input& in);
    void addBody(Input& in);
    void addCollider(Input& in);
    void ask(Input& in);
    void state(Input& in);
    BrittleShape shape(Input& in);

    BrittleContext* context;
    std::vector<BrittleMesh> meshes;
    std::vector<BrittleMaterial> materials;
    std::vector<BrittleWorld> worlds;
    std::vector<BrittleBody> bodies;
    std::vector<BrittleVec3> points;
    uint32_t started = 0;
};

void check(BrittleResult result, BrittleContext* context) {
    const bool known = std::strcmp(brittleResultName(result), "BRITTLE_UNKNOWN_RESULT") != 0;
    const bool is_bug = result == BRITTLE_INTERNAL; // nothing that a host does may come to that
    if (known && !is_bug) return;
    std::fprintf(stderr, "%s: %s\n", brittleResultName(result), brittleLastError(context));
    std::abort();
}

void Player::addMesh(Input& in) {
    std::vector<float> positions(3 * (in.byte() % 24u) + 3);
    for (float& x : positions)
        x = static_cast<float>(in.number());
    std::vector<uint32_t> indices(3 * (in.byte() % 24u) + 3);
    for (uint32_t& index : indices)
        index = in.byte() % (positions.size() / 3 + (in.byte() == 0 ? 5 : 0));
    BrittleMeshDef def = brittleDefaultMeshDef();
    def.positions = maybe(in, positions[0]);
    def.vertex_count = static_cast<uint32_t>(positions.size() / 3);
    def.indices = maybe(in, indices[0]);
    def.index_count = static_cast<uint32_t>(indices.size());
    def.is_open = in.byte() & 1u;
    BrittleMesh mesh = {0};
    check(brittleCreateMesh(context, maybe(in, def), maybe(in, mesh)), context);
    if (mesh.id != 0) meshes.push_back(mesh);
}

void Player::addMaterial(Input& in) {
    BrittleMaterialDef def = brittleDefaultMaterialDef();
    double* const numbers[] = {&def.density, &def.youngs_modulus, &def.poisson_ratio, &def.eta, &def.smallest_cell};
    for (double* number : numbers)
        if (in.byte() < 64) *number = in.number();
    const char* const likes[] = {"glass", "stone", "", "wood", nullptr};
    if (in.byte() < 64) def.like = likes[in.byte() % std::size(likes)];
    BrittleMaterial material = {0};
    check(brittleCreateMaterial(context, maybe(in, def), maybe(in, material)), context);
    if (material.id != 0) materials.push_back(material);
}

void Player::addWorld(Input& in) {
    BrittleWorldDef def = brittleDefaultWorldDef();
    def.effects = in.byte() < 200 ? BRITTLE_EFFECT_GRAVITY | BRITTLE_EFFECT_CONTACTS : in.raw<uint32_t>();
    if (in.byte() < 32) def.gravity = in.vector();
    if (in.byte() < 32) def.dt = in.number();
    if (in.byte() < 32) def.substeps = in.count();
    if (in.byte() < 32) def.budget.pairs = in.count();
    def.has_surfaces = in.byte() & 1u;
    BrittleWorld world = {0};
    check(brittleCreateWorld(context, maybe(in, def), maybe(in, world)), context);
    if (world.id != 0) worlds.push_back(world);
}

BrittleShape Player::shape(Input& in) {
    BrittleShape shape = brittleDefaultBodyDef().shape;
    shape.kind = in.byte() % 6u;
    if (in.byte() < 64) shape.size = in.vector();
    if (in.byte() < 64) shape.radius = in.number();
    if (in.byte() < 64) shape.corners = in.count();
    points.resize(in.byte() % 16u);
    for (BrittleVec3& point : points)
        point = in.vector();
    shape.points = points.data();
    shape.point_count = static_cast<uint32_t>(points.size());
    shape.mesh = pick(in, meshes);
    return shape;
}

void Player::addBody(Input& in) {
    BrittleBodyDef def = brittleDefaultBodyDef();
    def.shape = shape(in);
    if (in.byte() < 128) def.position = in.vector();
    if (in.byte() < 64) def.rotation = in.quat();
    if (in.byte() < 32) def.velocity = in.vector();
    if (in.byte() < 32) def.mass = in.number();
    if (in.byte() < 64) def.material = pick(in, materials);
    BrittleBody body = {0};
    check(brittleAddBody(context, pick(in, worlds), maybe(in, def), maybe(in, body)), context);
    if (body.id != 0) bodies.push_back(body);
}

void Player::addCollider(Input& in) {
    BrittleColliderDef def = brittleDefaultColliderDef();
    if (in.byte() < 128) def.shape = shape(in);
    if (in.byte() < 64) def.position = in.vector();
    if (in.byte() < 64) def.rotation = in.quat();
    BrittleBody body = {0};
    check(brittleAddCollider(context, pick(in, worlds), maybe(in, def), maybe(in, body)), context);
    if (body.id != 0) bodies.push_back(body);
}

void Player::ask(Input& in) {
    const BrittleWorld world = pick(in, worlds);
    const BrittleBody body = pick(in, bodies);
    BrittleBodyState states[4];
    BrittleBreak breaks[4];
    BrittleImpact impacts[4];
    BrittleVertex vertices[64];
    BrittleCounts counts = {};
    counts.struct_size = in.byte() < 8 ? in.count() : static_cast<uint32_t>(sizeof counts);
    uint32_t count = 0, outer = 0;
    uint64_t hash = 0;
    const BrittleBody two[] = {body, pick(in, bodies)};
    uint32_t of_two[2] = {}, outer_of_two[2] = {};
    switch (in.byte() % 10) {
    case 0: return check(brittleGetBodies(context, world, states, in.byte() % 5u, maybe(in, count)), context);
    case 1: return check(brittleGetBody(context, world, body, maybe(in, states[0])), context);
    case 2: return check(brittleGetBreaks(context, world, breaks, in.byte() % 5u, maybe(in, count)), context);
    case 3: return check(brittleGetCounts(context, world, maybe(in, counts)), context);
    case 4: return check(brittleHashState(context, world, maybe(in, hash)), context);
    case 5: return check(brittleNumberOf(context, world, body, maybe(in, count)), context);
    case 6: return check(brittleUpdateDraws(context, world, in.vector()), context);
    case 7: return check(brittleGetImpacts(context, world, impacts, in.byte() % 5u, maybe(in, count)), context);
    case 8:
        return check(brittleGetSurfaces(context, world, two, in.byte() % 3u, vertices, in.byte() % 65u, maybe(in, count),
                                        maybe(in, of_two[0]), maybe(in, outer_of_two[0])),
                     context);
    default:
        return check(brittleGetSurface(context, world, body, vertices, in.byte() % 65u, maybe(in, count), maybe(in, outer)),
                     context);
    }
}

void Player::state(Input& in) {
    const BrittleWorld world = pick(in, worlds);
    size_t size = 0;
    check(brittleSaveState(context, world, nullptr, 0, &size), context);
    std::vector<uint8_t> bytes(size < (1u << 24) ? size : 0);
    check(brittleSaveState(context, world, bytes.data(), bytes.size(), maybe(in, size)), context);
    if (!bytes.empty() && in.byte() < 128) bytes[in.raw<uint32_t>() % bytes.size()] ^= in.byte();
    check(brittleRestoreState(context, world, bytes.data(), bytes.size()), context);
}

void Player::play(Input& in) {
    while (!in.isOver()) {
        switch (in.byte() % 16) {
        case 0: addMesh(in); break;
        case 1: addMaterial(in); break;
        case 2: addWorld(in); break;
        case 3:
        case 4:
        case 5: addBody(in); break;
        case 6: addCollider(in); break;
        case 7: check(brittleDestroyMesh(context, pick(in, meshes)), context); break;
        case 8: check(brittleDestroyMaterial(context, pick(in, materials)), context); break;
        case 9: check(brittleDestroyWorld(context, pick(in, worlds)), context); break;
        case 10:
            if (in.byte() < 16 && started++ < 1) check(brittleStartWorld(context, pick(in, worlds)), context);
            break;
        case 11: check(brittleStep(context, pick(in, worlds), in.byte() % 3u), context); break;
        case 12: check(brittleDamage(context, pick(in, worlds), in.vector(), in.number(), in.number()), context); break;
        case 13: state(in); break;
        default: ask(in); break;
        }
    }
}

BrittleContext* makeContext() {
    const BrittleContextDef def = brittleDefaultContextDef();
    BrittleContext* context = nullptr;
    if (brittleCreateContext(&def, &context) != BRITTLE_OK) std::exit(EXIT_FAILURE);
    return context;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static BrittleContext* context = makeContext();
    Input in(data, size);
    Player(context).play(in);
    return 0;
}
