// Whether results that were read are such as a sweep leaves: a page or a price is made of nothing else.
#pragma once

#include "tools/accuracy/results.h"

namespace accuracy {

// What is wrong with them first, beginning with its place in the file; empty where nothing is. What follows from other
// numbers, medians and what judge() tells, is not looked at.
std::string flawOf(const Results& results);

} // namespace accuracy
