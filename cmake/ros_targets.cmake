# The ROS side: conversions as a library for others, too; the rooms of the nodes; the nodes; installation.
# catkin_lint sees no targets that a function makes: libraries are made here, and given what all have.
function(split_mapf_build_ros_library ros_library)
  target_include_directories(${ros_library} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  #catkin_lint: ignore_once external_interface_path
  target_include_directories(${ros_library} SYSTEM PUBLIC ${catkin_INCLUDE_DIRS})
  target_link_libraries(${ros_library} PUBLIC split_mapf_core ${catkin_LIBRARIES})
  add_dependencies(${ros_library} ${${PROJECT_NAME}_EXPORTED_TARGETS} ${catkin_EXPORTED_TARGETS})
  split_mapf_compile_options(${ros_library})
endfunction()

file(GLOB SPLIT_MAPF_CONVERT_SOURCES CONFIGURE_DEPENDS src/ros/convert/*.cpp)
file(GLOB SPLIT_MAPF_CLIENT_SOURCES CONFIGURE_DEPENDS src/ros/client/*.cpp)
split_mapf_in_units(split_mapf_ros SPLIT_MAPF_CONVERT_SOURCES)
split_mapf_in_units(split_mapf_client SPLIT_MAPF_CLIENT_SOURCES)
add_library(split_mapf_ros ${SPLIT_MAPF_CONVERT_SOURCES})
add_library(split_mapf_client ${SPLIT_MAPF_CLIENT_SOURCES})
foreach(ros_library split_mapf_ros split_mapf_client)
  split_mapf_build_ros_library(${ros_library})
  # Nor does it look into one.
  #catkin_lint: ignore_once external_interface_path
  target_include_directories(${ros_library} SYSTEM PUBLIC ${catkin_INCLUDE_DIRS})
endforeach()
foreach(room server replay fleet scene)
  file(GLOB sources CONFIGURE_DEPENDS src/ros/${room}/*.cpp)
  split_mapf_in_units(split_mapf_ros_${room} sources)
  add_library(split_mapf_ros_${room} STATIC ${sources})
  split_mapf_build_ros_library(split_mapf_ros_${room})
  target_link_libraries(split_mapf_ros_${room} PUBLIC split_mapf_ros)
endforeach()

target_compile_definitions(split_mapf_ros_server PRIVATE SPLIT_MAPF_VERSION="${PROJECT_VERSION}")
if(SPLIT_MAPF_RECONFIGURE)
  target_compile_definitions(split_mapf_ros_server PRIVATE SPLIT_MAPF_HAS_RECONFIGURE)
  target_include_directories(split_mapf_ros_server SYSTEM PRIVATE ${dynamic_reconfigure_INCLUDE_DIRS})
  target_link_libraries(split_mapf_ros_server PUBLIC ${dynamic_reconfigure_LIBRARIES})
endif()
# Solvers of other packages, where pluginlib is; without it ~solver_plugins is refused.
find_package(pluginlib QUIET)
if(pluginlib_FOUND)
  target_compile_definitions(split_mapf_ros_server PRIVATE SPLIT_MAPF_HAS_PLUGINLIB)
  target_include_directories(split_mapf_ros_server SYSTEM PRIVATE ${pluginlib_INCLUDE_DIRS})
  target_link_libraries(split_mapf_ros_server PUBLIC ${pluginlib_LIBRARIES})
else()
  message(STATUS "pluginlib is not here: planner_node loads no solvers of other packages")
endif()

foreach(node planner_node replay_node executor_node fake_robots_node)
  add_executable(${node} src/node/${node}.cpp src/node/run_node.cpp src/node/end_signal.cpp)
  target_include_directories(${node} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  split_mapf_compile_options(${node})
endforeach()
target_sources(planner_node PRIVATE src/node/memory_return.cpp)
target_link_libraries(planner_node PRIVATE split_mapf_ros_server split_mapf_available_solvers split_mapf_workers)
target_link_libraries(replay_node PRIVATE split_mapf_ros_replay)
target_link_libraries(executor_node PRIVATE split_mapf_ros_fleet split_mapf_available_solvers)
target_link_libraries(fake_robots_node PRIVATE split_mapf_ros_fleet)

# The bridge to robots that speak VDA 5050 over MQTT, where libmosquitto is.
find_path(MOSQUITTO_INCLUDE_DIR mosquitto.h)
find_library(MOSQUITTO_LIBRARY mosquitto)
mark_as_advanced(MOSQUITTO_INCLUDE_DIR MOSQUITTO_LIBRARY)
if(MOSQUITTO_INCLUDE_DIR AND MOSQUITTO_LIBRARY)
  add_executable(vda5050_bridge_node
    src/node/vda5050_bridge_node.cpp src/node/mqtt_client.cpp src/node/run_node.cpp src/node/end_signal.cpp)
  target_include_directories(vda5050_bridge_node
    PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src ${MOSQUITTO_INCLUDE_DIR})
  target_link_libraries(vda5050_bridge_node PRIVATE split_mapf_ros_fleet ${MOSQUITTO_LIBRARY})
  split_mapf_compile_options(vda5050_bridge_node)
  install(TARGETS vda5050_bridge_node RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
else()
  message(STATUS "libmosquitto is not here: vda5050_bridge_node is left out")
endif()

# An example of what conducts a fleet from above, in C++; in Python it is examples/warehouse_manager.py.
add_executable(warehouse_manager examples/warehouse_manager.cpp)
target_link_libraries(warehouse_manager PRIVATE split_mapf_ros)
split_mapf_compile_options(warehouse_manager)
install(TARGETS warehouse_manager RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})

catkin_install_python(PROGRAMS scripts/plan_client.py scripts/check_distances.py scripts/fleet_client.py
  scripts/resolve_bag.py scripts/route_driver.py scripts/start_rviz.py examples/warehouse_manager.py
  DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(TARGETS split_mapf_core ${SPLIT_MAPF_ILP_LIBRARY} split_mapf_ros split_mapf_client
  ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
  LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
  RUNTIME DESTINATION ${CATKIN_GLOBAL_BIN_DESTINATION})
install(TARGETS split_mapf planner_node replay_node executor_node fake_robots_node
  RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(DIRECTORY include/split_mapf/ DESTINATION ${CATKIN_PACKAGE_INCLUDE_DESTINATION})
install(DIRECTORY launch config rviz examples DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
