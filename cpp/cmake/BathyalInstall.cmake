# SPDX-License-Identifier: BSD-3-Clause
# Headers, libraries and `find_package(bathyal)` for C++ users; the Python package installs its own
# component (pyproject.toml).
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

get_property(modules GLOBAL PROPERTY BATHYAL_MODULES)
install(TARGETS ${modules} EXPORT bathyalTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/cpp/bathyal DESTINATION include FILES_MATCHING
        PATTERN "*.hpp" PATTERN internal EXCLUDE)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/bathyal)
install(EXPORT bathyalTargets NAMESPACE bathyal:: DESTINATION ${package_dir})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/bathyalConfig.cmake.in
  ${PROJECT_BINARY_DIR}/bathyalConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/bathyalConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/bathyalConfig.cmake
  ${PROJECT_BINARY_DIR}/bathyalConfigVersion.cmake DESTINATION ${package_dir})
