# The plug-in of rviz: a display, a panel and a tool, where rviz's own headers are.
# (On Debian librviz-dev; without it everything else is built.)
find_package(rviz QUIET)
if(rviz_FOUND)
  find_package(Qt5 ${rviz_QT_VERSION} QUIET COMPONENTS Widgets)
endif()
if(NOT rviz_FOUND OR NOT Qt5_FOUND)
  message(STATUS "rviz's headers are not here: its plug-in split_mapf_rviz is left out")
  return()
endif()

file(GLOB SPLIT_MAPF_RVIZ_SOURCES CONFIGURE_DEPENDS src/rviz/*.cpp)
split_mapf_in_units(split_mapf_rviz SPLIT_MAPF_RVIZ_SOURCES)
add_library(split_mapf_rviz SHARED ${SPLIT_MAPF_RVIZ_SOURCES})
target_include_directories(split_mapf_rviz PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
target_include_directories(split_mapf_rviz SYSTEM PRIVATE ${rviz_INCLUDE_DIRS} ${OGRE_INCLUDE_DIRS})
target_link_libraries(split_mapf_rviz PRIVATE
  split_mapf_ros_scene split_mapf_ros_replay ${rviz_LIBRARIES} Qt5::Widgets)
target_compile_definitions(split_mapf_rviz PRIVATE QT_NO_KEYWORDS)
split_mapf_compile_options(split_mapf_rviz)

install(TARGETS split_mapf_rviz LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
install(FILES plugin_description.xml DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
