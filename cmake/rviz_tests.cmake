# The plug-in in rviz itself, on a screen that nobody sees: where the plug-in is built and Xvfb is there.
find_program(SPLIT_MAPF_XVFB_RUN xvfb-run)
find_package(rosbag QUIET)
if(NOT TARGET split_mapf_rviz OR NOT SPLIT_MAPF_XVFB_RUN OR NOT rosbag_FOUND)
  message(STATUS "rviz's plug-in, xvfb-run or rosbag is not here: the plug-in is not tested")
  return()
endif()
add_rostest_gtest(player_rostest test/rviz/player.test
  test/rviz/player_rostest.cpp test/rviz/rviz_window.cpp)
add_dependencies(player_rostest split_mapf_rviz planner_node)
# No test: what robots cost rviz, for a person to read.
add_executable(rviz_frame_cost EXCLUDE_FROM_ALL test/rviz/frame_cost.cpp test/rviz/rviz_window.cpp)
foreach(target player_rostest rviz_frame_cost)
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/test)
  target_include_directories(${target} SYSTEM PRIVATE ${rviz_INCLUDE_DIRS} ${rosbag_INCLUDE_DIRS})
  target_link_libraries(${target}
    split_mapf_ros ${rviz_LIBRARIES} ${rosbag_LIBRARIES} Qt5::Widgets ${GTEST_LIBRARIES})
  target_compile_definitions(${target} PRIVATE QT_NO_KEYWORDS)
  target_compile_options(${target} PRIVATE ${SPLIT_MAPF_WARNINGS} -O1)
endforeach()
