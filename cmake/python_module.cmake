# The module split_mapf._core, by which Python plans without ROS. Left out where pybind11 or the
# headers of Python are missing, and under sanitizers, as Python itself has none.
option(SPLIT_MAPF_PYTHON_MODULE "Build the planner as a module for Python, where pybind11 is" ON)
if(NOT SPLIT_MAPF_PYTHON_MODULE OR SPLIT_MAPF_SANITIZE)
  return()
endif()
find_package(Python3 QUIET COMPONENTS Interpreter Development)
if(Python3_Development_FOUND AND NOT DEFINED PYTHON_EXECUTABLE)
  set(PYTHON_EXECUTABLE ${Python3_EXECUTABLE})
endif()
if(Python3_Development_FOUND)
  find_package(pybind11 QUIET CONFIG)
endif()
if(NOT pybind11_FOUND)
  message(STATUS "pybind11 or Python's headers are not here: the module split_mapf._core is left out")
  return()
endif()

file(GLOB SPLIT_MAPF_PYTHON_MODULE_SOURCES CONFIGURE_DEPENDS python/*.cpp)
split_mapf_in_units(split_mapf_python SPLIT_MAPF_PYTHON_MODULE_SOURCES)
add_library(split_mapf_python MODULE ${SPLIT_MAPF_PYTHON_MODULE_SOURCES})
target_include_directories(split_mapf_python PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/python ${CMAKE_CURRENT_SOURCE_DIR}/src)
target_compile_definitions(split_mapf_python PRIVATE SPLIT_MAPF_VERSION="${PROJECT_VERSION}")
target_link_libraries(split_mapf_python PRIVATE split_mapf_available_solvers pybind11::module)
split_mapf_compile_options(split_mapf_python)
if(SPLIT_MAPF_ROS)
  set(SPLIT_MAPF_PYTHON_DESTINATION ${CATKIN_GLOBAL_PYTHON_DESTINATION})
else()
  set(SPLIT_MAPF_PYTHON_DESTINATION lib/python3/dist-packages)
  foreach(source IN LISTS SPLIT_MAPF_PYTHON_SOURCES)
    get_filename_component(folder ${source} DIRECTORY)
    install(FILES python/${source} DESTINATION ${SPLIT_MAPF_PYTHON_DESTINATION}/${folder})
  endforeach()
endif()
set_target_properties(split_mapf_python PROPERTIES
  OUTPUT_NAME _core
  PREFIX ""
  SUFFIX ${PYTHON_MODULE_EXTENSION}
  CXX_VISIBILITY_PRESET hidden
  LIBRARY_OUTPUT_DIRECTORY ${SPLIT_MAPF_PYTHON_DIR}/split_mapf
  INSTALL_RPATH $ORIGIN/../../..)
#catkin_lint: ignore_once undefined_target wrong_install_destination
install(TARGETS split_mapf_python LIBRARY DESTINATION ${SPLIT_MAPF_PYTHON_DESTINATION}/split_mapf)
