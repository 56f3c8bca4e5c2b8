# Tests on other devices: a newer lavapipe (tools/newer_lavapipe.sh), other subgroup sizes, fewer features, changed kernels. A test
# whose device cannot be had is skipped with code 77, and prints the reason.
set(newer_lavapipe ${PROJECT_SOURCE_DIR}/tools/newer_lavapipe.sh)
set(shatter_bytes ${CMAKE_CURRENT_SOURCE_DIR}/device/shatter_bytes.sh ${CMAKE_BINARY_DIR})

add_executable(same_fragments device/same_fragments.cpp)
target_link_libraries(same_fragments PRIVATE brittle_test_support)

function(device_test name)
    add_test(NAME ${name} COMMAND ${ARGN})
    set_tests_properties(${name} PROPERTIES LABELS quick TIMEOUT 3600 SKIP_RETURN_CODE 77)
endfunction()

device_test(kernel_on_newer_lavapipe ${newer_lavapipe} $<TARGET_FILE:brittle_tests_kernel> --gtest_brief=1 --gtest_filter=-Long*)
set_property(TEST kernel_on_newer_lavapipe PROPERTY COST 500)

# The same bytes on one driver, the same fragments on all.
device_test(shatter_reference ${shatter_bytes} reference 10 100 1000)
set_tests_properties(shatter_reference PROPERTIES FIXTURES_SETUP shatter_reference)
device_test(shatter_on_newer_lavapipe ${shatter_bytes} newer 10 100 1000)
device_test(shatter_with_subgroups_of_4 ${shatter_bytes} subgroup_4 100)
device_test(shatter_without_features ${shatter_bytes} without_all 100)
set_tests_properties(shatter_on_newer_lavapipe shatter_with_subgroups_of_4 shatter_without_features
    PROPERTIES FIXTURES_REQUIRED shatter_reference)

# Kernels whose lanes work together: in a subgroup, or in a workgroup through shared memory. The larger tests are left out, since
# another width has a cache of its own. At 16 lanes only a test's own kernel runs: Mesa 22.3 rounds ties wrongly there, see
# modules/brittle/docs/drivers.md.
set(cooperating SmallScan.* SmallSortBoxes.* SmallSites.* SmallCaps.* SmallFans.* SmallMass.* SmallIslands.* SmallPools.*
    SmallBroadPhase.* SmallSphereTree.* SmallColorContacts.* SmallPacking.* SmallWeldPoints.* CutCells.OfUniformSitesOfManyCounts)
list(JOIN cooperating ":" cooperating)
set(with_subgroups ${CMAKE_CURRENT_SOURCE_DIR}/device/with_subgroups_of.sh)
device_test(kernel_with_subgroups_of_4 ${with_subgroups} 4 $<TARGET_FILE:brittle_tests_kernel> --gtest_brief=1
    --gtest_filter=${cooperating}:-Long*)
foreach(lanes 4 16)
    device_test(device_with_subgroups_of_${lanes} ${with_subgroups} ${lanes} $<TARGET_FILE:brittle_tests_device> --gtest_brief=1
        --gtest_filter=SubgroupSize*)
endforeach()

device_test(motion_with_subgroups_of_4 ${CMAKE_CURRENT_SOURCE_DIR}/device/motion_with_subgroups.sh ${CMAKE_BINARY_DIR} 2
    ${CMAKE_CURRENT_SOURCE_DIR}/device/many_blows.toml hard_35_dropped_100 hard_18_implosion hull_pile_100 hard_38_cradle_touching
    ${PROJECT_SOURCE_DIR}/modules/brittle/scene/examples/window_pane.toml)

device_test(compare_with_subgroups_of_4 ${CMAKE_CURRENT_SOURCE_DIR}/device/compare_with_subgroups.sh ${CMAKE_BINARY_DIR}
    card_house hull_pile_100)

device_test(device_kit_scripts ${CMAKE_CURRENT_SOURCE_DIR}/device/kit_scripts.sh ${CMAKE_BINARY_DIR}/kit-scripts)

device_test(planted_constants ${CMAKE_CURRENT_SOURCE_DIR}/device/planted_constants.sh ${CMAKE_BINARY_DIR} ${GLSLANG} ${SPIRV_OPT})

# Every kernel has a test that fails if the kernel does nothing. The quick one takes kernels that no test of the kernels alone runs.
get_property(kernel_names GLOBAL PROPERTY brittle_shaders_names)
list(JOIN kernel_names "\n" kernel_names)
file(WRITE ${CMAKE_BINARY_DIR}/kernel_names.txt "${kernel_names}\n")
set(empty_kernels ${CMAKE_CURRENT_SOURCE_DIR}/device/empty_kernels.sh ${CMAKE_BINARY_DIR} ${CMAKE_BINARY_DIR}/kernel_names.txt)
device_test(empty_kernels ${empty_kernels} solve_contacts bounce_rest time_rest claim_strikes wake_struck weigh_fragments write_draws
    bound_partings check_breaking)
device_test(empty_kernels_all ${empty_kernels})
set_tests_properties(empty_kernels_all PROPERTIES LABELS long)

# Missing barriers are noticed: the tests of barriers that need the layer skip in the program's other run.
add_brittle_test(barriers_validated brittle_tests_engine "Barriers.*" quick)
set_property(TEST barriers_validated APPEND PROPERTY ENVIRONMENT VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation
    VK_LAYER_ENABLES=VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT:VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT)
