# The plugin in the real engine, which tools/godot.sh obtains; each of these is skipped, and says why, where that cannot be.
set(engine_test ${CMAKE_CURRENT_SOURCE_DIR}/godot/engine_test.sh)
foreach(mode interface headless screen)
    add_test(NAME godot_${mode} COMMAND ${engine_test} ${mode} ${CMAKE_BINARY_DIR} ${CMAKE_CXX_COMPILER})
    set_tests_properties(godot_${mode} PROPERTIES LABELS quick TIMEOUT 1200 SKIP_RETURN_CODE 77)
endforeach()
add_test(NAME godot_symbols COMMAND ${CMAKE_COMMAND} -DLIBRARY=$<TARGET_FILE:brittle_godot>
    -DSYMBOLS=${CMAKE_CURRENT_SOURCE_DIR}/godot/symbols.txt -P ${CMAKE_CURRENT_SOURCE_DIR}/abi/symbols_test.cmake)
set_tests_properties(godot_symbols PROPERTIES LABELS quick)
