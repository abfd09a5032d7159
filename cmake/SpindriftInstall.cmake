# SPDX-License-Identifier: MIT
# The command, its scenes, and the library for find_package(spindrift).
include(CMakePackageConfigHelpers)

set(spindrift_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/spindrift)

install(TARGETS spindrift RUNTIME)
get_property(spindrift_parts GLOBAL PROPERTY SPINDRIFT_LIBRARIES)
install(TARGETS spindrift_embed ${spindrift_parts} spindrift_core spindrift_numerics EXPORT spindrift ARCHIVE)
install(EXPORT spindrift NAMESPACE spindrift:: FILE spindriftTargets.cmake DESTINATION ${spindrift_package_dir})

# The public headers, and the two of core that they name; these include nothing but the standard library.
install(DIRECTORY include/spindrift DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES core/error.h core/flake.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/spindrift/core)
install(DIRECTORY scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/spindrift)
install(FILES LICENSE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

configure_package_config_file(cmake/spindriftConfig.cmake.in ${PROJECT_BINARY_DIR}/spindriftConfig.cmake
                              INSTALL_DESTINATION ${spindrift_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/spindriftConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/spindriftConfig.cmake ${PROJECT_BINARY_DIR}/spindriftConfigVersion.cmake
        DESTINATION ${spindrift_package_dir})
