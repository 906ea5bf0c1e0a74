# Tests that start real programs: the command, the nodes, a downstream package.
add_test(NAME layering
  COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/test/layering_test.sh ${CMAKE_CURRENT_SOURCE_DIR})
if(SPLIT_MAPF_ROS)
  add_test(NAME downstream
    COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/test/downstream/downstream_test.sh ${CMAKE_BINARY_DIR})
endif()
add_test(NAME downstream_plain
  COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/test/downstream/plain_test.sh ${CMAKE_BINARY_DIR})
# The system's python, without other packages: it is there wherever ROS is.
find_program(SPLIT_MAPF_PYTHON python3 HINTS /usr/bin)
add_test(NAME tool
  COMMAND ${CMAKE_COMMAND} -E env SPLIT_MAPF_COMMAND=$<TARGET_FILE:split_mapf>
    SPLIT_MAPF_EXAMPLE_PLUGINS=$<TARGET_FILE:split_mapf_downstream_plugins>
    SPLIT_MAPF_MISBEHAVING_PLUGINS=$<TARGET_FILE:split_mapf_misbehaving_plugins>
    ${SPLIT_MAPF_PYTHON} -B -m unittest discover -s ${CMAKE_CURRENT_SOURCE_DIR}/test/tool -p *_test.py)
set_tests_properties(tool PROPERTIES TIMEOUT 600)

# The package for Python, where its module is built and numpy is there.
if(TARGET split_mapf_python)
  execute_process(COMMAND ${PYTHON_EXECUTABLE} -c "import numpy" RESULT_VARIABLE status ERROR_QUIET)
  if(status EQUAL 0)
    add_test(NAME python
      COMMAND ${CMAKE_COMMAND} -E env PYTHONPATH=${SPLIT_MAPF_PYTHON_DIR}
        SPLIT_MAPF_COMMAND=$<TARGET_FILE:split_mapf>
        ${PYTHON_EXECUTABLE} -B -m unittest discover -s ${CMAKE_CURRENT_SOURCE_DIR}/test/python -p *_test.py)
    set_tests_properties(python PROPERTIES TIMEOUT 300)
  else()
    message(STATUS "numpy is not here: the test of the package for Python is left out")
  endif()
endif()

# Tests run side by side. These measure time, so they have the machine to themselves: programs of
# seconds, and rostests that hold the node to its limits. The other rostests mostly wait for states.
# What takes longest begins first. Under sanitizers nobody looks at time.
get_property(split_mapf_tests DIRECTORY PROPERTY TESTS)
foreach(test IN LISTS split_mapf_tests)
  if(NOT SPLIT_MAPF_SANITIZE AND (test MATCHES "(core|solver|pipeline|ilp|ros)_tests$"
      OR test MATCHES "rostest.*(big_maps|plan_server|strange_goals|termination)"))
    set_tests_properties(${test} PROPERTIES RUN_SERIAL ON)
  elseif(test MATCHES "rostest")
    set_tests_properties(${test} PROPERTIES COST 100)
  elseif(test MATCHES "conformance_tests")
    set_tests_properties(${test} PROPERTIES COST 200)
  endif()
endforeach()
