// How many substeps an island takes.
//
// A stack of n cubes with the edge e sinks by g n^2 / (e hertz^2) of an edge, times a constant, and buckles if it sinks much further. So
// the substeps K of a contact follow from
//     K^2 = kGive (60 dt)^2 |g| / e * load * (height + kBase).
// The load counts in weights of the lighter body. e is the edge of a cube as wide as the smaller body, or less if that is thin. The
// height is that of the island, in bodies. A body on its own cannot buckle: kLone stands in place of the bracket. The island takes
// the mean over its contacts, weighted by their loads: pebbles among blocks do not decide.
//
// The number changes slowly, because overlap would be thrown out by contacts that become stiff at once. While no contact has carried
// anything, each is taken to carry the whole height, or the heavier of its bodies.
//
// Wants lib/softness.glsl, lib/island_heights.glsl, `color_ends`, `solver_contacts`, `solver_bodies`, `shapes` and PacePush as `push_` declared.
shared uint member_count;
const float kGive = 0.06, kBase = 2.6, kLone = 0.3;
const float kEdgeOfRadius = 1.1547005; // of a cube
const float kMostRatio = 300.0;        // of masses, where no load is known yet
const float kHeaviest = 255.0;         // of the load, in whole numbers: their sum does not depend on the order

// Mesa's software device stops a lane after 65,535 turns of loops, all together. turnsOf is the most that a substep takes with 8
// lanes: 8 for each vector of contacts of a color and 2 for the color, twice for each iteration, and 5 for each side of a contact that
// a vector of bodies looks at. The rest of the turns is for the search for heights, impacts, and bodies that turn fast.
const uint kLanes = 8u, kMostTurns = 30000u, kMostContacts = FEW_CONTACTS;

uint turnsOf(uvec2 range, uint bodies, uint most_sides) {
    uint colors = 0u, at = range.x;
    for (uint color = 0u; color < kMostContacts && at < range.y; color++) {
        colors += 2u + 8u * ((color_ends[at] - at + kLanes - 1u) / kLanes);
        at = color_ends[at];
    }
    uint vectors = (bodies + kLanes - 1u) / kLanes;
    return 2u * push_.iterations * colors + min(10u * (range.y - range.x), 5u * most_sides * vectors) + 10u * vectors;
}

uint substepsAtOnce(uint turns) { return max(kMostTurns / turns, 1u); }

// Heaps, whose bodies have several contacts each, do not buckle. So in the soft solver their contacts carry loads (LOAD_CARRIED), and they
// get no more substeps than it takes to keep bodies from sinking into each other by more than a small share of their thickness, and no
// more than is cheap.
//
// But walls of bricks do buckle, and so do columns that touch. Islands in which nearly all contacts are faces that meet in four points are
// stacks, if the substeps of a stack are cheap there. So are those of bodies of several cells, which have many contacts each.
const uint kCheapTurns = 12000u;
const float kSinkingShare = 0.02;
const float kSpring = 2.0 * 3.14159265 * STIFFEST; // of a contact: angular frequency times the substep

bool isHeap(uint contacts, uint bodies) { return push_.heaps_too == 0u && contacts > bodies + bodies / 4u + 1u; }

bool nearlyAll(uint some, uint all_) { return 5u * some > 4u * all_; }

uint affordable(bool is_heap, uint turns) { return is_heap ? kCheapTurns / turns : push_.most_parts * substepsAtOnce(turns); }

shared uint most_load, last_pace, coming_pace, shares, shared_paces, shared_sinking; // sums over contacts, weighted by loads, the last two

float loadOf(uint c) {
    float sum = 0.0;
    for (uint k = 0u; k < MANIFOLD_POINTS && k < solver_contacts[c].ids.z; k++) sum += solver_contacts[c].points[k].pulse.x;
    return sum * float(push_.substeps) / push_.gravity.w;
}

// Of the point that gives way the furthest: how many weights of its effective mass it carries.
float mostCarried(uint c, float g) {
    float most = 0.0;
    for (uint k = 0u; k < MANIFOLD_POINTS && k < solver_contacts[c].ids.z; k++) {
        SolverPoint p = solver_contacts[c].points[k];
        most = max(most, p.arm_b.w > 0.0 ? p.pulse.x / p.arm_b.w : 0.0);
    }
    return most * float(push_.substeps) / (push_.gravity.w * g);
}

// 0 for a body that does not move.
float inverseMassOf(uint body) { return solver_bodies[body].velocity.w; }

// Of a thin body the mean of its width and its thickness counts.
float edgeOf(uint body) {
    float wide = kEdgeOfRadius * shapes[body].inverse_inertia[2].w, thin = 2.0 * uintBitsToFloat(shapes[body].pieces.z);
    float edge = wide * sqrt(min(thin / wide, 1.0));
    return inverseMassOf(body) != 0.0 ? edge : 3e38;
}

// Returns whether one body of a contact may lean on the other in this step. Where gravity moves bodies by about their size in a step, contacts are
// looked for as far away: a cube of a stack has some with all others. Such a contact makes no stack lower, and no stack a heap.
const float kLeaning = 0.9; // edges of the smaller body: points further apart do not count
const float kFarFall = 0.5; // edges: the rule holds if a body at rest would fall this far in a step

bool mayLean(uint c) {
    uvec4 ids = solver_contacts[c].ids;
    float nearest = 3e38;
    for (uint k = 0u; k < MANIFOLD_POINTS && k < ids.z; k++) nearest = min(nearest, solver_contacts[c].points[k].arm_a.w);
    float edge = min(edgeOf(ids.x), edgeOf(ids.y)), fall = length(push_.gravity.xyz) * push_.gravity.w * push_.gravity.w;
    return nearest < kLeaning * edge || fall < kFarFall * edge;
}

float ratioOf(uvec2 ids) {
    float a = inverseMassOf(ids.x), b = inverseMassOf(ids.y), least = min(a, b);
    return least > 0.0 ? min(max(a, b) / least, kMostRatio) : 1.0;
}

// A body that is so much heavier than what it comes to needs its substeps in the step in which it comes.
// In the soft solver a cube twice as wide counts, and less does not: stones of one heap are left alone.
float muchHeavier() { return push_.heaps_too != 0u ? 4.0 : 7.5; }

const float kPinnedRatio = 1.5;

// Returns whether one body of a contact would drive the other one away: it is much heavier, or heavier than one that lies on what
// does not move. Wants the heights of this step.
bool isUneven(uvec2 ids) {
    float a = inverseMassOf(ids.x), b = inverseMassOf(ids.y), ratio = ratioOf(ids);
    return ratio > muchHeavier() || (ratio > kPinnedRatio && heights[a > b ? ids.x : ids.y] == 1u);
}

bool may_hurry; // false for a heap
const float kComesFast = 0.05; // edges in a step

bool comesFast(uint c) {
    uvec4 ids = solver_contacts[c].ids;
    float slowest = kComesFast * min(edgeOf(ids.x), edgeOf(ids.y)) / push_.gravity.w;
    bool comes = false;
    for (uint k = 0u; k < MANIFOLD_POINTS && k < ids.z; k++) comes = comes || solver_contacts[c].points[k].pulse.z < -slowest;
    return comes;
}

bool comesHeavy(uint c) {
    if (!may_hurry || most_load == 0u || loadOf(c) != 0.0) return false;
    uvec2 ids = solver_contacts[c].ids.xy;
    return ratioOf(ids) > muchHeavier() || (isUneven(ids) && comesFast(c));
}

// In weights of the lighter body.
float weightsOn(uint c, float g, float height) {
    uvec4 ids = solver_contacts[c].ids;
    float ratio = ratioOf(ids.xy);
    if (most_load == 0u || comesHeavy(c)) return max(height, ratio);
    return max(loadOf(c) * max(inverseMassOf(ids.x), inverseMassOf(ids.y)) / g, 1.0);
}

float paceOfContact(uint c, float g, float height) {
    uvec4 ids = solver_contacts[c].ids;
    float edge = min(edgeOf(ids.x), edgeOf(ids.y));
    float buckles = member_count == 1u ? kLone : height + kBase;
    return push_.stiffer * 60.0 * push_.gravity.w * sqrt(kGive * g / edge * weightsOn(c, g, height) * buckles);
}

float thicknessOf(uint body) { return inverseMassOf(body) != 0.0 ? 2.0 * uintBitsToFloat(shapes[body].pieces.z) : 3e38; }

// With so many substeps the contact gives way by kSinkingShare of the thinner body.
float paceAgainstSinking(uint c, float g) {
    uvec4 ids = solver_contacts[c].ids;
    float thin = min(thicknessOf(ids.x), thicknessOf(ids.y));
    return push_.gravity.w / kSpring * sqrt(mostCarried(c, g) * g / (kSinkingShare * thin));
}

void clearPace(uint lane) {
    if (lane != 0u) return;
    most_load = 0u;
    last_pace = 0u;
    coming_pace = 0u;
    shares = 0u;
    shared_paces = 0u;
    shared_sinking = 0u;
}

void gatherLoads(uint lane, uvec2 range) {
    for (uint c = range.x + lane; c < range.y; c += LANES) {
        atomicMax(most_load, floatBitsToUint(loadOf(c)));
        atomicMax(last_pace, solver_contacts[c].pace.x);
    }
}

void gatherPaces(uint lane, uvec2 range, float g, float height) {
    float most = uintBitsToFloat(most_load);
    for (uint c = range.x + lane; c < range.y; c += LANES) {
        uint share = most > 0.0 ? uint(kHeaviest * (loadOf(c) / most) + 0.5) : 1u;
        float pace = min(paceOfContact(c, g, height), float(push_.most_substeps));
        float sinking = min(paceAgainstSinking(c, g), float(push_.most_substeps));
        if (comesHeavy(c)) atomicMax(coming_pace, uint(ceil(pace)));
        atomicAdd(shares, share);
        atomicAdd(shared_paces, share * uint(ceil(pace)));
        atomicAdd(shared_sinking, share * uint(ceil(sinking)));
    }
}

// A pace that is hardly too fast stays: contacts give way by another length at each, and bodies would hop between them.
uint slowerThan(uint last, uint wanted) { return 5u * wanted < 4u * last ? last - max(last / 16u, 1u) : last; }

uint meanPace(uint sum) { return (sum + shares - 1u) / shares; }

// `carries`: contacts are to carry loads (LOAD_CARRIED), in a heap or for want of substeps.
uint paceFrom(bool is_heap, bool is_ordered, uint most, out bool carries) {
    bool weighs = shares != 0u;
    uint stiff_pace = weighs ? meanPace(shared_paces) : push_.substeps;
    if (is_ordered && stiff_pace <= most) is_heap = false;
    uint wanted = weighs && is_heap ? min(stiff_pace, meanPace(shared_sinking)) : stiff_pace;
    if (last_pace != 0u) wanted = clamp(wanted, slowerThan(last_pace, wanted), last_pace + max(last_pace / 4u, 1u));
    if (!is_heap) wanted = max(wanted, coming_pace);
    uint pace = max(min(wanted, min(most, push_.most_substeps)), push_.substeps);
    carries = is_heap || stiff_pace > pace;
    return pace;
}

uint paceOf(uint lane, uvec2 range, uint height, bool is_heap, bool is_ordered, uint most, out bool carries) {
    float g = length(push_.gravity.xyz);
    clearPace(lane);
    barrier();
    gatherLoads(lane, range);
    barrier();
    if (g > 0.0) gatherPaces(lane, range, g, float(height));
    barrier();
    return paceFrom(is_heap, is_ordered, most, carries);
}
