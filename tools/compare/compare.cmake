# brittle compare: one scene on two devices.
if(TARGET brittle)
    set(compare_dir ${CMAKE_CURRENT_LIST_DIR})
    target_sources(brittle PRIVATE ${compare_dir}/compare_command.cpp ${compare_dir}/compare_report.cpp
        ${compare_dir}/motion_recording.cpp ${compare_dir}/recording_comparison.cpp ${compare_dir}/scene_hash.cpp)
endif()
