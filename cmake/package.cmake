# The CMake package of what knows no ROS: find_package(split_mapf) offers split_mapf::core and, where
# it was built, split_mapf::ilp. A build with ROS installs catkin's package of that name; there this
# one is a component of its own, installed only by who asks for it:
#   cmake --install BUILD --component cmake_package --prefix PREFIX
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/split_mapf)
set(package_component COMPONENT cmake_package)
if(SPLIT_MAPF_ROS)
  list(APPEND package_component EXCLUDE_FROM_ALL)
endif()

set_target_properties(split_mapf_core PROPERTIES EXPORT_NAME core)
if(SPLIT_MAPF_ILP)
  set_target_properties(split_mapf_ilp PROPERTIES EXPORT_NAME ilp)
endif()
# A static library leaves what it links to who links it, a shared one only what it offers.
get_target_property(core_type split_mapf_core TYPE)
get_target_property(core_links split_mapf_core LINK_LIBRARIES)
set(SPLIT_MAPF_DEPENDENCIES Threads)
foreach(library IN LISTS core_links)
  if(core_type STREQUAL STATIC_LIBRARY AND library MATCHES "^(yaml-cpp)$|^([A-Za-z_-]+)::")
    list(APPEND SPLIT_MAPF_DEPENDENCIES ${CMAKE_MATCH_1}${CMAKE_MATCH_2})
  endif()
endforeach()
list(REMOVE_DUPLICATES SPLIT_MAPF_DEPENDENCIES)
configure_package_config_file(cmake/split_mapfConfig.cmake.in package/split_mapfConfig.cmake
  INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(package/split_mapfConfigVersion.cmake COMPATIBILITY SameMinorVersion)

install(TARGETS split_mapf_core ${SPLIT_MAPF_ILP_LIBRARY} EXPORT split_mapf_targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} ${package_component}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ${package_component}
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
#catkin_lint: ignore_once wrong_install_destination
install(DIRECTORY include/split_mapf DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} ${package_component}
  PATTERN ros EXCLUDE PATTERN client.h EXCLUDE)
install(EXPORT split_mapf_targets NAMESPACE split_mapf:: FILE split_mapfTargets.cmake
  DESTINATION ${package_dir} ${package_component})
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/package/split_mapfConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/package/split_mapfConfigVersion.cmake
  DESTINATION ${package_dir} ${package_component})
