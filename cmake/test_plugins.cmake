# Libraries of plug-ins for the tests: the example of test/downstream, which the package of somebody
# else builds for itself, too, and one that does everything wrong.
add_library(split_mapf_downstream_plugins SHARED test/downstream/plugins.cpp)
add_library(split_mapf_misbehaving_plugins SHARED
  test/plugin/misbehaving_plugin.cpp test/plugin/misbehaving_exports.cpp)
foreach(library split_mapf_downstream_plugins split_mapf_misbehaving_plugins)
  target_include_directories(${library} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/test)
  target_link_libraries(${library} PRIVATE split_mapf_core)
  target_compile_options(${library} PRIVATE ${SPLIT_MAPF_WARNINGS} -O1)
  if(SPLIT_MAPF_ROS AND pluginlib_FOUND)
    target_include_directories(${library} SYSTEM PRIVATE ${pluginlib_INCLUDE_DIRS})
    target_link_libraries(${library} PRIVATE ${pluginlib_LIBRARIES})
  else()
    target_compile_definitions(${library} PRIVATE PLUGINS_WITHOUT_ROS)
  endif()
endforeach()
