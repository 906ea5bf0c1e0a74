# The Python package split_mapf: its sources are copied to where the modules of the messages are
# generated, so that all of them are one package; without ROS to python/ in the build directory.
if(SPLIT_MAPF_ROS)
  set(SPLIT_MAPF_PYTHON_DIR ${CATKIN_DEVEL_PREFIX}/${PYTHON_INSTALL_DIR})
else()
  set(SPLIT_MAPF_PYTHON_DIR ${CMAKE_CURRENT_BINARY_DIR}/python)
endif()
file(GLOB_RECURSE SPLIT_MAPF_PYTHON_SOURCES CONFIGURE_DEPENDS
  RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}/python python/split_mapf/*.py)
if(NOT SPLIT_MAPF_ROS)
  list(FILTER SPLIT_MAPF_PYTHON_SOURCES EXCLUDE REGEX "/ros/")
endif()
foreach(source IN LISTS SPLIT_MAPF_PYTHON_SOURCES)
  configure_file(python/${source} ${SPLIT_MAPF_PYTHON_DIR}/${source} COPYONLY)
endforeach()
