# What is installed, all of it from the sources: nothing needs to be built. The build folder, too, is a package for find_package.
include(CMakePackageConfigHelpers)
set(package ${CMAKE_INSTALL_DATADIR}/cmake/gnomon)

install(DIRECTORY include/gnomon DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/licenses/gnomon)

configure_file(cmake/gnomon-config.cmake gnomon-config.cmake COPYONLY)
write_basic_package_version_file(gnomon-config-version.cmake COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES ${PROJECT_BINARY_DIR}/gnomon-config.cmake ${PROJECT_BINARY_DIR}/gnomon-config-version.cmake DESTINATION ${package})
install(TARGETS gnomon gnomon_bit_exact gnomon_packages EXPORT gnomon-targets)
install(EXPORT gnomon-targets NAMESPACE gnomon:: DESTINATION ${package})
export(EXPORT gnomon-targets NAMESPACE gnomon::)

# pkg-config finds the prefix from its own file's place, as CMake does, unless the folder is an absolute one.
if(IS_ABSOLUTE ${CMAKE_INSTALL_DATADIR})
    set(prefix ${CMAKE_INSTALL_PREFIX})
else()
    file(RELATIVE_PATH prefix /${CMAKE_INSTALL_DATADIR}/pkgconfig /)
    string(REGEX REPLACE "/$" "" prefix "\${pcfiledir}/${prefix}")
endif()
foreach(folder INCLUDEDIR DATADIR)
    set(${folder} ${CMAKE_INSTALL_${folder}})
    cmake_path(ABSOLUTE_PATH ${folder} BASE_DIRECTORY "\${prefix}")
endforeach()
configure_file(cmake/gnomon.pc.in gnomon.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/gnomon.pc DESTINATION ${CMAKE_INSTALL_DATADIR}/pkgconfig)
