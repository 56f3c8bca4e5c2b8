# Writes OUTPUT anew where version, compiler or commit have changed. Run as a script at every build.
execute_process(COMMAND git describe --always --dirty WORKING_DIRECTORY ${SOURCE_DIR} OUTPUT_VARIABLE commit
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed OR NOT commit)
    set(commit "unknown")
endif()
set(text "#define BRITTLE_VERSION \"${VERSION}\"\n#define BRITTLE_COMPILER \"${COMPILER}\"\n#define BRITTLE_COMMIT \"${commit}\"\n")
set(before "")
if(EXISTS ${OUTPUT})
    file(READ ${OUTPUT} before)
endif()
if(NOT before STREQUAL text)
    file(WRITE ${OUTPUT} "${text}")
endif()
