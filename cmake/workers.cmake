# Workers on other machines, over NATS, in a library of the programs' own; without libnats (it is not in Ubuntu
# 20.04) the programs say so when workers are asked for.
option(SPLIT_MAPF_WORKERS "Build workers on other machines, where libnats is" ON)
if(SPLIT_MAPF_WORKERS)
  find_path(NATS_INCLUDE_DIR nats/nats.h)
  find_library(NATS_LIBRARY nats)
  mark_as_advanced(NATS_INCLUDE_DIR NATS_LIBRARY)
endif()
if(SPLIT_MAPF_WORKERS AND NATS_INCLUDE_DIR AND NATS_LIBRARY)
  include(cmake/hashed_sources.cmake)
  split_mapf_hashed_sources(${CMAKE_CURRENT_SOURCE_DIR} SPLIT_MAPF_HASHED)
  # Flags that hold folders of one machine change no plan.
  string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
  string(REGEX REPLACE "-f[a-z]+-prefix-map=[^ ]*" "" flags "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}}")
  set(versions "Boost ${Boost_VERSION}")
  if(SPLIT_MAPF_ILP)
    # Of the header; a library of another version at run time is not noticed.
    file(STRINGS ${GLPK_INCLUDE_DIR}/glpk.h glpk REGEX "^#define GLP_(MAJOR|MINOR)_VERSION")
    string(APPEND versions " GLPK ${glpk}")
  endif()
  set(source_hash ${CMAKE_CURRENT_BINARY_DIR}/source_hash.cpp)
  add_custom_command(OUTPUT ${source_hash}
    COMMAND ${CMAKE_COMMAND} -DROOT=${CMAKE_CURRENT_SOURCE_DIR} -DOUTPUT=${source_hash} -DVERSION=${PROJECT_VERSION}
      "-DFLAVOUR=${CMAKE_SYSTEM_PROCESSOR} ${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} ${CMAKE_BUILD_TYPE} ${SPLIT_MAPF_ILP} ${SPLIT_MAPF_SANITIZE} ${flags} ${versions}"
      -P ${CMAKE_CURRENT_SOURCE_DIR}/cmake/source_hash.cmake
    DEPENDS ${SPLIT_MAPF_HASHED} cmake/source_hash.cmake cmake/hashed_sources.cmake VERBATIM)
  file(GLOB SPLIT_MAPF_WORKERS_SOURCES CONFIGURE_DEPENDS src/workers/*.cpp)
  split_mapf_in_units(split_mapf_workers SPLIT_MAPF_WORKERS_SOURCES)
  add_library(split_mapf_workers STATIC ${SPLIT_MAPF_WORKERS_SOURCES} ${source_hash})
  target_compile_definitions(split_mapf_workers PRIVATE SPLIT_MAPF_HAS_WORKERS)
  target_include_directories(split_mapf_workers SYSTEM PRIVATE ${NATS_INCLUDE_DIR})
  target_link_libraries(split_mapf_workers PRIVATE Boost::boost nlohmann_json::nlohmann_json ${NATS_LIBRARY})
else()
  message(STATUS "libnats is not here: pieces are solved in one process only")
  add_library(split_mapf_workers STATIC src/workers/workers.cpp)
endif()
target_include_directories(split_mapf_workers PUBLIC ${CMAKE_CURRENT_SOURCE_DIR}/src)
target_link_libraries(split_mapf_workers PUBLIC split_mapf_core)
split_mapf_compile_options(split_mapf_workers)
