# Tests of the ROS side: conversions without a master, then the real nodes under rostest.
find_package(rostest REQUIRED)

add_library(split_mapf_ros_test_support STATIC EXCLUDE_FROM_ALL
  test/ros/goal_messages.cpp test/ros/strange_goals.cpp test/ros/tracked_goal.cpp)
target_include_directories(split_mapf_ros_test_support PUBLIC ${CMAKE_CURRENT_SOURCE_DIR}/test)
target_link_libraries(split_mapf_ros_test_support PUBLIC split_mapf_ros)
split_mapf_compile_options(split_mapf_ros_test_support)

split_mapf_add_tests(ros FOLDERS ros LIBRARIES split_mapf_ros_server split_mapf_ros_replay split_mapf_ros_fleet
  split_mapf_ros_scene split_mapf_ros_test_support split_mapf_available_solvers ${YAML_CPP_LIBRARIES})

foreach(name plan_server queue recall strange_goals answers discs)
  add_rostest_gtest(${name}_rostest test/ros/${name}.test
    test/ros/${name}_rostest.cpp test/ros/rostest_main.cpp)
  target_include_directories(${name}_rostest PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/test ${CMAKE_CURRENT_SOURCE_DIR}/src)
  target_link_libraries(${name}_rostest split_mapf_ros_test_support split_mapf_test_support ${GTEST_LIBRARIES})
  target_compile_options(${name}_rostest PRIVATE ${SPLIT_MAPF_WARNINGS} -O1)
endforeach()
target_link_libraries(queue_rostest split_mapf_ros_server)
target_sources(plan_server_rostest PRIVATE test/ros/plan_server_bad_goals.cpp)

add_executable(plan_two_robots EXCLUDE_FROM_ALL examples/plan_two_robots.cpp)
target_link_libraries(plan_two_robots split_mapf_client)
split_mapf_compile_options(plan_two_robots)
add_rostest_gtest(fleet_client_rostest test/ros/client.test
  test/ros/fleet_client_rostest.cpp test/ros/rostest_main.cpp)
target_link_libraries(fleet_client_rostest split_mapf_client ${GTEST_LIBRARIES})
target_compile_options(fleet_client_rostest PRIVATE ${SPLIT_MAPF_WARNINGS} -O1)
add_dependencies(fleet_client_rostest planner_node split_mapf plan_two_robots)

foreach(name replay recording lifecycle sim_time big_maps termination)
  add_rostest(test/ros/${name}.test DEPENDENCIES planner_node replay_node split_mapf
    split_mapf_downstream_plugins split_mapf_misbehaving_plugins)
endforeach()
add_rostest(test/ros/launch.test
  DEPENDENCIES planner_node replay_node executor_node fake_robots_node warehouse_manager)
foreach(name fleet move)
  add_rostest(test/ros/${name}.test DEPENDENCIES executor_node fake_robots_node split_mapf)
endforeach()
add_rostest(test/ros/disc_fleet.test DEPENDENCIES executor_node fake_robots_node planner_node)
find_program(SPLIT_MAPF_PYTHON python3 HINTS /usr/bin)
add_test(NAME check_distances COMMAND ${CATKIN_ENV} ${SPLIT_MAPF_PYTHON} -B
  ${CMAKE_CURRENT_SOURCE_DIR}/test/ros/check_distances_test.py)
set(SPLIT_MAPF_BRIDGE)
if(TARGET vda5050_bridge_node)
  set(SPLIT_MAPF_BRIDGE vda5050_bridge_node)
endif()
add_rostest(test/ros/robots.test DEPENDENCIES executor_node split_mapf ${SPLIT_MAPF_BRIDGE})
include(cmake/rviz_tests.cmake)
