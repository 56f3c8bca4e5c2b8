// cap_faces, cap_faces_large and cap_faces_huge on polygons made by hand: the triangles of a cap have the polygon's outline,
// edge by edge, none is turned over, and their areas add up.
#include "tests/kernel/cap_polygons.h"

#include <random>

namespace kernel_test {
namespace {

// Every kernel that has room for the polygons must triangulate them, not only the one that gets them in earnest.
void expectCapped(const std::vector<CapPolygon>& polygons, const CapBasis& basis = kCapBases[0]) {
    size_t longest = 0;
    for (const CapPolygon& polygon : polygons)
        longest = std::max(longest, polygon.segments.size());
    const CapRun in_turn = capOnDevice(polygons, basis, Through::AllInTurn);
    for (size_t f = 0; f < polygons.size(); ++f)
        expectTriangulated(polygons[f], in_turn.triangles[f]);
    EXPECT_EQ(in_turn.bad, 0u);
    for (const Through kernel : {Through::Large, Through::Huge, Through::Vast}) {
        if (kernel != Through::Vast && longest > (kernel == Through::Large ? LARGE_FACE : HUGE_FACE)) continue;
        const CapRun run = capOnDevice(polygons, basis, kernel);
        for (size_t f = 0; f < polygons.size(); ++f)
            expectTriangulated(polygons[f], run.triangles[f]);
        EXPECT_EQ(run.bad + run.turned_over, 0u);
    }
}

CapPolygon ringOf(uint32_t corners, int32_t radius = 100'000) {
    CapLoop loop;
    for (uint32_t k = 0; k < corners; ++k) {
        const double angle = 2 * std::numbers::pi * k / corners;
        loop.push_back({static_cast<int32_t>(radius * std::cos(angle)), static_cast<int32_t>(radius * std::sin(angle))});
    }
    return polygonOf({loop});
}

// Seen whole from the middle, with corners of any depth.
CapPolygon starOf(uint32_t corners, std::mt19937& random) {
    CapLoop loop;
    for (uint32_t k = 0; k < corners; ++k) {
        const double angle = 2 * std::numbers::pi * k / corners, radius = static_cast<double>(20'000 + random() % 80'000);
        loop.push_back({static_cast<int32_t>(radius * std::cos(angle)), static_cast<int32_t>(radius * std::sin(angle))});
    }
    return polygonOf({loop});
}

// Teeth so narrow that no tooth sees into another.
CapPolygon combOf(int32_t teeth) {
    CapLoop loop = {{-5, -1000}, {teeth * 100, -1001}};
    for (int32_t k = teeth; k-- > 0;) {
        loop.push_back({k * 100 + 30, 10'000 + k % 3});
        loop.push_back({k * 100, k % 2});
    }
    return polygonOf({loop});
}

CapLoop squareAt(int32_t x, int32_t y, int32_t half) {
    return {{x - half, y - half}, {x + half, y - half}, {x + half, y + half}, {x - half, y + half}};
}
std::vector<CapLoop> thirtySquares() {
    std::vector<CapLoop> squares(30);
    for (int32_t k = 0; k < 30; ++k)
        squares[static_cast<size_t>(k)] = squareAt(k % 6 * 100, k / 6 * 100, 10 + k);
    return squares;
}
CapLoop reversed(CapLoop loop) {
    std::reverse(loop.begin(), loop.end());
    return loop;
}

const CapLoop kEll = {{0, 0}, {40, 0}, {40, 10}, {10, 10}, {10, 30}, {0, 30}};

TEST(SmallCaps, OfConvexPolygons) {
    std::vector<CapPolygon> polygons;
    for (const uint32_t corners : {3u, 4u, 5u, 12u, 24u})
        polygons.push_back(ringOf(corners));
    EXPECT_EQ(capOnDevice(polygons, kCapBases[0], Through::AllInTurn).wide, 0u) << "a lane can do them";
    for (const uint32_t corners : {25u, 63u, 64u, 65u, 256u})
        polygons.push_back(ringOf(corners));
    expectCapped(polygons);
}

TEST(SmallCaps, OfPolygonsInEveryDirection) {
    for (const CapBasis& basis : kCapBases)
        expectCapped({ringOf(7), polygonOf({kEll}), polygonOf({squareAt(0, 0, 90), reversed(squareAt(3, 7, 40))})}, basis);
}

TEST(SmallCaps, OfConcavePolygons) {
    std::mt19937 random(1);
    std::vector<CapPolygon> polygons = {polygonOf({kEll}), combOf(3), combOf(11), combOf(40), combOf(120)};
    for (const uint32_t corners : {8u, 24u, 25u, 100u, 256u})
        polygons.push_back(starOf(corners, random));
    expectCapped(polygons);
}

// Those with few corners are done by a lane each, however deep their corners.
TEST(SmallCaps, OfAsManyFacesAsThereAre) {
    for (const uint32_t count : kSizes) {
        std::mt19937 random(count);
        std::vector<CapPolygon> polygons;
        uint32_t wide = 0;
        for (uint32_t f = 0; f < count; ++f) {
            polygons.push_back(starOf(static_cast<uint32_t>(3 + random() % 26), random));
            wide += polygons[f].segments.size() > SMALL_FACE ? 1 : 0;
        }
        const CapRun run = capOnDevice(polygons, kCapBases[0], Through::AllInTurn);
        for (size_t f = 0; f < count; ++f)
            expectTriangulated(polygons[f], run.triangles[f]);
        EXPECT_EQ(run.wide, wide);
    }
}

TEST(SmallCaps, OfHolesAndIslands) {
    const CapLoop outline = squareAt(0, 0, 1000);
    std::mt19937 random(5);
    std::vector<CapLoop> sieve = {outline};
    for (int32_t k = 0; k < 25; ++k) {
        sieve.push_back(reversed(squareAt(k % 5 * 300 - 600, k / 5 * 300 - 600, 80)));
        for (CapPoint& p : sieve.back())
            p = {p[0] + static_cast<int32_t>(random() % 41), p[1] + static_cast<int32_t>(random() % 41)};
    }
    expectCapped({polygonOf({outline, reversed(squareAt(10, -20, 300))}), polygonOf({outline, reversed(kEll)}),
                  polygonOf({outline, reversed(squareAt(-500, 1, 300)), reversed(squareAt(500, 0, 300))}),
                  polygonOf({outline, reversed(squareAt(0, 0, 700)), squareAt(0, 0, 400), reversed(squareAt(5, 5, 100))}),
                  polygonOf(sieve)});
}

// Corners are in parts of a grid step, and triangles may be turned over by two steps.
void expectCappedButForRounding(CapPolygon polygon) {
    polygon.per_step = 64;
    polygon.crosses = 128;
    for (const Through kernel : {Through::AllInTurn, Through::Large, Through::Huge}) {
        const CapRun run = capOnDevice({polygon}, kCapBases[0], kernel);
        expectTriangulated(polygon, run.triangles[0]);
        EXPECT_EQ(run.bad, 0u);
    }
}

// Found in a teapot, where two parts of the surface touch: a slit, 1500 steps deep, whose sides have changed places by less
// than a step. No large triangle may be turned over for that.
TEST(SmallCaps, OfASlitThatIsTurnedOver) {
    const CapPolygon polygon = polygonOf(
        {{{-3165552, -22277997}, {7407851, -34564440},  {21734763, -37823549}, {34185432, -35787753}, {41076578, -33420555},
          {31146219, -14213036}, {25641011, -10323099}, {22922568, -8467128},  {19916012, -6633986},  {14139203, -3111797},
          {8549678, -481600},    {7333513, 36431},      {7116326, 51156},      {4612726, 220888},     {4612715, 220899},
          {4710663, 132596},     {4319137, 485564},     {2576641, 2056455},    {2065908, 2516890},    {-444170, 4779769},
          {-3247630, 7307138},   {-3672274, 7689962},   {-2024468, 7677026},   {-245572, 7663084},    {581988, 7744675},
          {2259704, 7910065},    {2601544, 8008609},    {3897605, 8382246},    {3996450, 8459979},    {4722243, 9030774},
          {4726637, 9082799},    {4787821, 9806855},    {4754137, 9851883},    {4148295, 10661775},   {4047149, 10731140},
          {2857897, 11546715},   {2584449, 11672218},   {970667, 12412886},    {358003, 12614257},    {-1459225, 13211569},
          {-2624675, 13484040},  {-4377759, 13893890},  {-6339873, 14196552},  {-7730731, 14411087},  {-9957020, 14591968}}});
    expectCappedButForRounding(polygon);
}

// Of a slot whose walls have passed through each other by six steps: the outline goes round twice, and no corner is reflex. Its
// tip lies far from where it crosses itself, in the middle of what would be a large ear.
TEST(SmallCaps, OfAnOutlineThatGoesRoundTwice) {
    const CapPolygon polygon = polygonOf({{{-268435456, -171567246},
                                           {-245671346, -167929140},
                                           {-210533241, -112627895},
                                           {-210749437, -109546609},
                                           {-268435456, -84517045},
                                           {-268435456, -125977843},
                                           {-263959515, -130860773},
                                           {-260882360, -134217728},
                                           {-260881841, -134217728},
                                           {-260881834, -134217728},
                                           {-268435456, -125977269},
                                           {-268435456, -135251946},
                                           {-268435456, -135251874}}});
    expectCappedButForRounding(polygon);
}

// Found in a block with square holes: the hole's outline runs along the cap's own, there and back through different corners.
TEST(SmallCaps, OfSlitsBetweenManyCorners) {
    const CapLoop found = {{160557808, -103549655}, {220793440, -125401551}, {273139168, 0},          {-102140647, 0},
                           {-100340047, -8902945},  {68772264, -70252327},   {35806672, -58293327},   {21532506, -53115043},
                           {15195358, -50816079},   {12471542, -49827955},   {-3358664, -44085183},   {-3358664, -23553599},
                           {263307328, -23553599},  {255787936, -41567379},  {249965120, -55516747},  {248331328, -59430683},
                           {247727680, -60876867},  {245092224, -67190415},  {244163520, -69415263},  {240765056, -77556679},
                           {239523680, -80530639},  {235723712, -89634055},  {234120128, -93475671},  {230342240, -102526015},
                           {228318512, -107374183}, {224925664, -115502287}, {222516944, -121272695}, {220793456, -125401543},
                           {209412112, -121272695}, {176525664, -109342351}, {171100320, -107374183}};
    expectCappedButForRounding(polygonOf({found}));
    CapLoop few; // for a lane
    for (size_t k = 0; k < found.size(); ++k)
        if (k < 6 || k == 10 || k == 11 || k == 12 || k > 24) few.push_back(found[k]);
    expectCappedButForRounding(polygonOf({few}));
}

// Found in the same block: one side passes a corner of the other by a fraction of a step, here or there.
TEST(SmallCaps, OfAnOutlineThatTouchesItself) {
    const CapLoop found = {
        {10857045, -108689816}, {26821336, -117917000}, {57150388, -81266664}, {57640176, -76065976}, {57775900, -74624808},
        {58358168, -70490856},  {52554372, -66535336},  {51940172, -66116712}, {47412900, -60546472}, {46508572, -59433768},
        {43607080, -52476392},  {43116104, -51299080},  {42918148, -49773736}, {41912180, -42021960}, {42054392, -40613800},
        {42929728, -31945960},  {43072528, -31388072},  {44262188, -26740456}, {46000660, -21850856}, {46134364, -21474824},
        {48398904, -16480520},  {48521924, -16209192},  {48661868, -15956104}, {51400584, -11003720}, {51598396, -10724296},
        {57206880, -2802600},   {57726864, -1074312},   {57830356, -814728},   {62473828, 7925368},   {63314432, 9078424},
        {69251112, 16317112},   {74653608, 20787608},   {76676936, 29899320},  {78175912, 36341624},  {83648384, 57290936},
        {92004600, 85899352},   {91395480, 85899352},   {89565840, 85899352}};
    for (int32_t shift = -96; shift <= 96; shift += 8) {
        SCOPED_TRACE(shift);
        CapLoop loop = found;
        loop[19][0] += shift;
        expectCappedButForRounding(polygonOf({loop}));
    }
}

TEST(SmallCaps, OfSeveralLoops) {
    const std::vector<CapLoop> squares = thirtySquares();
    expectCapped({polygonOf({squares[0], squares[1]}), polygonOf(squares), polygonOf({kEll, squareAt(25, 20, 9)})});
}

// Loops that share corners: whichever way they are chained, the outline and the area stay.
TEST(SmallCaps, OfTouchingLoops) {
    const CapLoop outline = squareAt(0, 0, 1000);
    const CapLoop hole_at_corner = {{-1000, -1000}, {-500, 0}, {0, -500}}, hole_at_side = {{1000, -1000}, {0, 300}, {600, 500}};
    std::vector<CapPolygon> polygons = {polygonOf({squareAt(0, 0, 50), squareAt(100, 100, 50)}),
                                        polygonOf({squareAt(0, 0, 50), squareAt(100, 100, 50), squareAt(200, 0, 50)}),
                                        polygonOf({outline, hole_at_corner}), polygonOf({outline, hole_at_side}),
                                        polygonOf({outline, reversed(squareAt(0, 0, 90)), reversed(squareAt(180, 180, 90))})};
    for (CapPolygon& polygon : polygons)
        polygon.triangles.reset();
    expectCapped(polygons);
}

// Two polygons with a side in common, walked both ways: the side is no boundary.
TEST(SmallCaps, LeaveOutSidesThatCancel) {
    CapPolygon both = polygonOf({{{0, 0}, {50, -20}, {60, 40}, {5, 60}}, {{60, 40}, {50, -20}, {120, 10}}});
    both.triangles = 3;
    CapPolygon nothing = polygonOf({{{0, 0}, {50, -20}}});
    nothing.triangles = 0;
    CapPolygon twice = polygonOf({kEll}); // one side there, back, and there again
    twice.segments.push_back({1, 0});
    twice.segments.push_back({0, 1});
    expectCapped({both, nothing, twice});
}

TEST(SmallCaps, LeaveOutSidesOfNoLength) {
    CapPolygon ell = polygonOf({kEll});
    ell.segments.push_back({2, 2});
    ell.segments.push_back({5, 5});
    expectCapped({ell});
}

// Flat corners may give triangles without area, but none that is turned over.
TEST(SmallCaps, KeepCornersOnStraightSides) {
    const CapLoop loop = {{0, 0}, {5, 0}, {20, 0}, {40, 0}, {40, 20}, {40, 30}, {0, 30}, {0, 10}, {0, 5}};
    CapPolygon polygon = polygonOf({loop});
    polygon.may_be_flat = true;
    expectCapped({polygon});
}

TEST(Caps, OfThreeHundredSides) {
    std::mt19937 random(3);
    expectCapped({ringOf(300, 1'000'000), starOf(300, random), combOf(149)});
}

TEST(Caps, OfTheMostSidesThatAreTaken) { expectCapped({ringOf(HUGE_FACE, 2'000'000)}); }

TEST(Caps, MayHaveMoreSidesThanAWorkgroupHolds) {
    std::mt19937 random(5);
    const std::vector<CapPolygon> polygons = {ringOf(HUGE_FACE + 1, 2'000'000), ringOf(3), starOf(5'000, random), combOf(2'500),
                                              starOf(2'100, random)};
    const CapRun run = capOnDevice(polygons, kCapBases[0], Through::AllInTurn);
    for (size_t f = 0; f < polygons.size(); ++f)
        expectTriangulated(polygons[f], run.triangles[f]);
    EXPECT_EQ(run.vast, 4u);
    EXPECT_EQ(run.bad + run.turned_over, 0u);
}

// Holes in rows that lie level, each with an island inside.
TEST(Caps, MayHaveMoreHolesThanAWorkgroupHolds) {
    std::vector<CapLoop> loops = {squareAt(0, 0, 100'000)};
    for (int32_t k = 0; k < 900; ++k) {
        const int32_t x = 6'000 * (k % 30) - 87'000, y = 6'000 * (k / 30) - 87'000 + k % 3;
        loops.push_back(reversed(squareAt(x, y, 2'000 + k % 7)));
        loops.push_back(squareAt(x + k % 5, y, 1'000));
    }
    CapPolygon polygon = polygonOf(loops);
    polygon.may_be_flat = true;
    const CapRun run = capOnDevice({polygon}, kCapBases[0], Through::AllInTurn);
    expectTriangulated(polygon, run.triangles[0]);
    EXPECT_EQ(run.vast, 1u);
    EXPECT_EQ(run.bad + run.turned_over, 0u);
}

// Lanes may take 65,535 loop turns on lavapipe, so no lane may look at all sides.
TEST(Caps, MayHaveAHundredThousandSides) {
    std::mt19937 random(9);
    CapLoop loop;
    for (uint32_t k = 0; k < 100'000; ++k) {
        const double angle = 2 * std::numbers::pi * k / 100'000;
        const double radius = 8e6 * (1 + 0.2 * std::sin(40 * angle)) + 800 * static_cast<double>(random() % 100);
        loop.push_back({static_cast<int32_t>(radius * std::cos(angle)), static_cast<int32_t>(radius * std::sin(angle))});
    }
    const CapPolygon polygon = polygonOf({loop});
    const CapRun run = capOnDevice({polygon}, kCapBases[0], Through::Vast);
    expectTriangulated(polygon, run.triangles[0]);
    EXPECT_EQ(run.bad + run.turned_over, 0u);
}

// A convex outline beside one long side is one mountain, too long for a lane before all workgroups have cut ears. Its sides are
// the vectors without a common divisor, by their slopes.
TEST(Caps, MayBeOneMountain) {
    std::vector<CapPoint> sides;
    for (int32_t x = 1; x <= 200; ++x)
        for (int32_t y = 1; y <= 200; ++y)
            if (std::gcd(x, y) == 1) sides.push_back({x, y});
    std::ranges::sort(sides, [](const CapPoint& a, const CapPoint& b) { return a[1] * b[0] < b[1] * a[0]; });
    CapLoop loop = {{0, 0}};
    for (const CapPoint& side : sides)
        loop.push_back({loop.back()[0] + side[0], loop.back()[1] + side[1]});
    const CapPolygon polygon = polygonOf({loop});
    const CapRun run = capOnDevice({polygon}, kCapBases[0], Through::Vast);
    expectTriangulated(polygon, run.triangles[0]);
    EXPECT_EQ(run.bad + run.turned_over, 0u);
}

// A ray to the right from the corner of one hole runs along the side of the next. Whatever order the sides come in.
TEST(SmallCaps, OfHolesInARow) {
    std::mt19937 random(1);
    const CapLoop outline = squareAt(0, 0, 1000);
    std::vector<CapLoop> row = {outline}, rows = {outline}; // level, and one up or down
    for (int32_t k = 0; k < 3; ++k)
        row.push_back(reversed(squareAt(550 * k - 600, 0, 100)));
    for (int32_t k = 0; k < 25; ++k)
        rows.push_back(reversed(squareAt(k % 5 * 300 - 600, k / 5 * 300 - 600 + k % 2, 80)));
    std::vector<CapPolygon> polygons = {polygonOf(row), polygonOf(rows)};
    for (uint32_t order = 0; order < 25; ++order) {
        for (CapPolygon& polygon : polygons) {
            polygon.may_be_flat = true;
            std::shuffle(polygon.segments.begin(), polygon.segments.end(), random);
        }
        expectCapped(polygons);
    }
}

// Where one loop is done rounds before another.
TEST(SmallCaps, HaveNoTriangleThatNamesACornerTwice) {
    const std::vector<CapLoop> squares = thirtySquares();
    for (const Through kernel : {Through::Large, Through::Huge}) {
        EXPECT_EQ(capOnDevice({polygonOf({kEll, squareAt(25, 20, 9)})}, kCapBases[0], kernel).collapsed, 0u);
        EXPECT_EQ(capOnDevice({polygonOf(squares)}, kCapBases[0], kernel).collapsed, 0u);
    }
}

} // namespace
} // namespace kernel_test
