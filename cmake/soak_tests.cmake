# Long versions of random tests, for scripts/analyse soak: many more seeds than the usual run has. A
# plain ctest leaves them out; `ctest -C soak -L soak` runs them and nothing else. They have the
# environment variable SPLIT_MAPF_LONG=1, by which a test asks for its long version
# (test/support/long_run.h).
function(split_mapf_add_soak name)
  add_test(NAME soak_${name} CONFIGURATIONS soak COMMAND ${ARGN}
    WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
  set_tests_properties(soak_${name} PROPERTIES
    LABELS soak ENVIRONMENT SPLIT_MAPF_LONG=1 TIMEOUT 900)
endfunction()

if(TARGET core_tests)
  split_mapf_add_soak(solvability core_tests --gtest_filter=SolvabilityOracle.*)
endif()
if(TARGET solver_tests)
  split_mapf_add_soak(lacam solver_tests --gtest_filter=Lacam.FindsAPlanOrProves*)
endif()
if(TARGET pipeline_tests)
  split_mapf_add_soak(reservations pipeline_tests --gtest_filter=Reservations.AreKeptByEvery*)
  split_mapf_add_soak(fleet pipeline_tests --gtest_filter=FleetRuns.*)
  split_mapf_add_soak(disc_execution pipeline_tests --gtest_filter=DiscExecution.*:DiscSimulation.*)
  split_mapf_add_soak(fleet_crowd pipeline_tests --gtest_filter=FleetCrowd.*)
  split_mapf_add_soak(vda5050 pipeline_tests --gtest_filter=Vda5050Fleet.*)
endif()
if(TARGET faults_tests)
  split_mapf_add_soak(faults faults_tests)
endif()
# Without ilp: a few of so many instances keep it busy for minutes.
if(TARGET conformance_tests)
  split_mapf_add_soak(conformance
    conformance_tests --gtest_filter=*SolverConformance.IsHonestOn*-*ilp*)
endif()
if(SPLIT_MAPF_ROS)
  # rostest says how it went, but not by its exit code.
  foreach(name strange_goals termination)
    split_mapf_add_soak(${name} ${CMAKE_CURRENT_SOURCE_DIR}/test/ros/soak_rostest.sh
      ${CMAKE_BINARY_DIR}/devel/setup.bash test/ros/${name}.test)
    set_tests_properties(soak_${name} PROPERTIES RUN_SERIAL TRUE)  # they measure time
  endforeach()
  # Two minutes of what runs for an hour: see docs/evaluation.md.
  split_mapf_add_soak(plan_goals ${CATKIN_ENV} ${SPLIT_MAPF_PYTHON} -B
    ${CMAKE_CURRENT_SOURCE_DIR}/test/ros/plan_soak.py --minutes 2)
  set_tests_properties(soak_plan_goals PROPERTIES COST 100)  # what takes longest begins first
endif()
