# The ROS-free core library and the command.
file(GLOB SPLIT_MAPF_CORE_SOURCES CONFIGURE_DEPENDS
  src/core/*.cpp src/solvability/*.cpp src/parallel/*.cpp src/roadmap/*.cpp src/io/*.cpp src/search/*.cpp
  src/generate/*.cpp src/solver/*.cpp src/solver/*/*.cpp src/split/*.cpp src/plugin/*.cpp src/portfolio/*.cpp src/improve/*.cpp
  src/pipeline/*.cpp src/pipeline/*/*.cpp src/fleet/*.cpp)
# What links GLPK is no part of it: see ilp.cmake.
list(FILTER SPLIT_MAPF_CORE_SOURCES EXCLUDE REGEX "/src/solver/(ilp\\.cpp|ilp/|available/)")
# What `auto` expects of each method is data, built in so that the library finds it anywhere.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS config/cost_model.yaml)
file(READ config/cost_model.yaml SPLIT_MAPF_COST_MODEL)
configure_file(cmake/cost_model.cpp.in cost_model.cpp @ONLY)
split_mapf_in_units(split_mapf_core SPLIT_MAPF_CORE_SOURCES)
add_library(split_mapf_core ${SPLIT_MAPF_CORE_SOURCES} ${CMAKE_CURRENT_BINARY_DIR}/cost_model.cpp)
target_include_directories(split_mapf_core
  PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
  PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src ${YAML_CPP_INCLUDE_DIR})
target_link_libraries(split_mapf_core
  PUBLIC Threads::Threads
  PRIVATE Boost::boost ${YAML_CPP_LIBRARIES} nlohmann_json::nlohmann_json PNG::PNG ZLIB::ZLIB ${CMAKE_DL_LIBS})
# Animations need giflib; without it the command says so.
find_package(GIF 5)
if(GIF_FOUND)
  target_compile_definitions(split_mapf_core PRIVATE SPLIT_MAPF_HAS_GIF)
  target_link_libraries(split_mapf_core PRIVATE GIF::GIF)
endif()
split_mapf_compile_options(split_mapf_core)
split_mapf_call_own_functions(split_mapf_core)

include(cmake/ilp.cmake)
include(cmake/workers.cmake)

file(GLOB SPLIT_MAPF_TOOL_SOURCES CONFIGURE_DEPENDS src/tool/*.cpp)
split_mapf_in_units(split_mapf SPLIT_MAPF_TOOL_SOURCES)
add_executable(split_mapf ${SPLIT_MAPF_TOOL_SOURCES})
target_include_directories(split_mapf PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
target_compile_definitions(split_mapf PRIVATE SPLIT_MAPF_VERSION="${PROJECT_VERSION}")
target_link_libraries(split_mapf PRIVATE
  split_mapf_available_solvers split_mapf_workers Boost::program_options nlohmann_json::nlohmann_json)
split_mapf_compile_options(split_mapf)

if(NOT SPLIT_MAPF_ROS)
  install(TARGETS split_mapf RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
include(cmake/package.cmake)
