// Lets a script check that tests notice a wrong kernel.
#pragma once

namespace support {

// Reads BRITTLE_TEST_KERNEL=NAME=FILE.spv from the environment. The words of the file replace those of the kernel NAME in
// shaders::all(), so every kernel library of the program runs them: those of worlds and fractures, too. Call before any library
// exists. Without the variable nothing happens. Errors end the program with code 2, which no failed test has.
void plantKernel();

} // namespace support
