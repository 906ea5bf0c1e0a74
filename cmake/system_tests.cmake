# Tests that start real programs: the command, the nodes, a downstream package.
add_test(NAME layering
  COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/test/layering_test.sh ${CMAKE_CURRENT_SOURCE_DIR})
