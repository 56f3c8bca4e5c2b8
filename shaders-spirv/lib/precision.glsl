// How the signs of determinants are found: exactly, in integers and with ties decided by the ids of sites; or by evaluating the
// same determinants in floating point and taking the sign of what comes out.
//
// One constant decides, and what it leaves out vanishes from the pipeline. Doubles stand in modules of their own, built from the
// same files with DOUBLES defined, because a device that lacks them takes no module that names them. ALWAYS_EXACT is for what has
// no other precision.
#ifndef PRECISION_GLSL
#define PRECISION_GLSL

#if defined(ALWAYS_EXACT)
#define real float
#define real3 vec3
const bool kExact = true;
const bool kFast = false;
#elif defined(DOUBLES)
#define real double
#define real3 dvec3
const bool kExact = false;
const bool kFast = false;
#else
#define real float
#define real3 vec3
layout(constant_id = PRECISION_ID) const uint kPrecision = PRECISION_EXACT;
const bool kExact = kPrecision == PRECISION_EXACT;
const bool kFast = kPrecision == PRECISION_FAST;
#endif

int realSign(real x) { return x > real(0) ? 1 : (x < real(0) ? -1 : 0); }

#endif
