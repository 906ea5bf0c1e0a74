# catkin, and the messages, services and actions of the public interface.

# rospy and the message generators exist for the system's python only; another python3 that comes
# first in PATH would be picked without this.
if(NOT DEFINED PYTHON_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(PYTHON_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python that has the ROS modules")
endif()
if(NOT DEFINED Python3_EXECUTABLE AND DEFINED PYTHON_EXECUTABLE)
  set(Python3_EXECUTABLE ${PYTHON_EXECUTABLE} CACHE FILEPATH "Python that has the ROS modules")
endif()
# catkin caches the test environment while configuring: the directory has to stand by then, or
# python tests of the first build do not find the generated modules.
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/devel/lib/python3/dist-packages)

set(SPLIT_MAPF_CATKIN_DEPENDS
  actionlib actionlib_msgs diagnostic_updater geometry_msgs nav_msgs roscpp std_msgs tf2
  tf2_geometry_msgs tf2_ros visualization_msgs)
find_package(catkin REQUIRED COMPONENTS ${SPLIT_MAPF_CATKIN_DEPENDS} message_generation)

include(cmake/python_package.cmake)  # before its generated part, which would begin with an empty one
file(GLOB SPLIT_MAPF_MSG CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}/msg msg/*.msg)
file(GLOB SPLIT_MAPF_SRV CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}/srv srv/*.srv)
add_message_files(FILES ${SPLIT_MAPF_MSG})
add_service_files(FILES ${SPLIT_MAPF_SRV})
add_action_files(FILES PlanPaths.action ExecutePlan.action MoveRobots.action)
generate_messages(DEPENDENCIES actionlib_msgs geometry_msgs nav_msgs std_msgs)

# The defaults of planner_node while it runs, where dynamic_reconfigure is and can generate their code.
find_package(dynamic_reconfigure QUIET)
if(dynamic_reconfigure_FOUND)
  execute_process(COMMAND ${PYTHON_EXECUTABLE} -c "import dynamic_reconfigure.parameter_generator_catkin"
    RESULT_VARIABLE status ERROR_QUIET)
endif()
if(dynamic_reconfigure_FOUND AND status EQUAL 0)
  generate_dynamic_reconfigure_options(cfg/Planner.cfg)
  set(SPLIT_MAPF_RECONFIGURE ON)
else()
  message(STATUS "dynamic_reconfigure is not here: planner_node is not reconfigured while it runs")
  set(SPLIT_MAPF_RECONFIGURE OFF)
endif()

# Nobody else needs what planner_node alone includes.
#catkin_lint: ignore missing_catkin_depend
catkin_package(
  INCLUDE_DIRS include
  LIBRARIES split_mapf_core split_mapf_ros split_mapf_client
  CATKIN_DEPENDS ${SPLIT_MAPF_CATKIN_DEPENDS} message_runtime)
