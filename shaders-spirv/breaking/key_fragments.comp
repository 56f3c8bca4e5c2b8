// Whose each fragment is: the object on whose tile its site lies. By that fragments are sorted, since their own order goes by
// triangles, which are those of all objects.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/fragment_record.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, FragmentRecord, fragments);
READS(2, ivec4, sites);
WRITES(3, uint, owners);
WRITES(4, uint, order);
#include "lib/whose_fragment.glsl"

void main() {
    uint f = flatIndex();
    if (f >= counts[COUNT_FRAGMENTS]) return;
    owners[f] = objectOfFragment(f);
    order[f] = f;
}
