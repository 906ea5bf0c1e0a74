# Fewer, longer compilations: split_mapf_in_units(target variable) replaces the list of sources in
# the variable by files that each include several of them. Only with SPLIT_MAPF_SOURCES_PER_UNIT above 1.
set(SPLIT_MAPF_SOURCES_PER_UNIT 1 CACHE STRING
  "Sources that are compiled as one: more make a first build faster, and slower what follows a change")
if(SPLIT_MAPF_SOURCES_PER_UNIT GREATER 1)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
endif()

function(split_mapf_in_units target variable)
  if(NOT SPLIT_MAPF_SOURCES_PER_UNIT GREATER 1)
    return()
  endif()
  execute_process(
    COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/scripts/source_units.py
      ${CMAKE_CURRENT_BINARY_DIR}/units/${target} ${SPLIT_MAPF_SOURCES_PER_UNIT} ${${variable}}
    WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}
    OUTPUT_VARIABLE units OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "scripts/source_units.py failed for ${target}")
  endif()
  set(${variable} ${units} PARENT_SCOPE)
endfunction()
