# What `cmake --install` lays down: the program, plugins, graphs, headers and the CMake package `quell`. Nothing in it
# knows the prefix, which may therefore be moved.
include(CMakePackageConfigHelpers)
set(QUELL_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/quell)

install(TARGETS quell RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
get_filename_component(folder ${QUELL_IMAGE_FORMATS} DIRECTORY)
install(TARGETS quell_image_formats LIBRARY DESTINATION ${folder})
get_property(plugins GLOBAL PROPERTY QUELL_PLUGIN_NAMES)
if(plugins AND NOT QUELL_STATIC_PLUGINS)
  install(TARGETS ${plugins} LIBRARY DESTINATION ${QUELL_PLUGIN_DIR})
endif()
install(DIRECTORY graphs DESTINATION ${QUELL_DATA_DIR} PATTERN CMakeLists.txt EXCLUDE)
install(DIRECTORY core/include/quell DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

set_target_properties(quell_sdk PROPERTIES EXPORT_NAME sdk)
install(TARGETS quell_sdk EXPORT quell_targets)
install(EXPORT quell_targets NAMESPACE Quell:: FILE quellTargets.cmake DESTINATION ${QUELL_PACKAGE_DIR})
configure_package_config_file(cmake/quellConfig.cmake.in ${CMAKE_BINARY_DIR}/quellConfig.cmake
  INSTALL_DESTINATION ${QUELL_PACKAGE_DIR} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/quellConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/quellConfig.cmake ${CMAKE_BINARY_DIR}/quellConfigVersion.cmake cmake/QuellPlugin.cmake
  DESTINATION ${QUELL_PACKAGE_DIR})
