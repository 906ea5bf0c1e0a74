# Tests that start real programs: the command, the nodes, a downstream package.
add_test(NAME layering
  COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/test/layering_test.sh ${CMAKE_CURRENT_SOURCE_DIR})
if(SPLIT_MAPF_ROS)
  add_test(NAME downstream
    COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/test/downstream/downstream_test.sh ${CMAKE_BINARY_DIR})
endif()
