# What `cmake --install` lays down: the program, plugins, graphs, headers and a CMake package.
install(DIRECTORY core/include/quell DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
