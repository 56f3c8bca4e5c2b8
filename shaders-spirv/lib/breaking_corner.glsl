// Whose a corner or a site of what breaks is, and where a corner comes from. Wants `breaking` and `counts` declared.

// The last object that begins at or before it.
#define LAST_OBJECT(begin, at) \
    uint low_ = 0u, high_ = max(counts[COUNT_BREAKING], 1u) - 1u; \
    for (uint step = 0u; step < 9u && low_ < high_; step++) { \
        uint middle = (low_ + high_ + 1u) / 2u; \
        if (breaking[middle].begin <= at) low_ = middle; \
        else high_ = middle - 1u; \
    } \
    return low_;

uint objectOf(uint corner) { LAST_OBJECT(range.w, corner) }
uint objectOfSite(uint site) { LAST_OBJECT(sites.x, site) }

uint vertexOf(BreakingRecord object, uint corner) { return object.range.x + corner - object.range.w; }
bool isOfEarlierCut(BreakingRecord object, uint corner) { return corner - object.range.w >= object.range.y; }
