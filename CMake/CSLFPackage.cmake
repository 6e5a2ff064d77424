# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# CSLFConfig.cmake for the build and the install tree.
include(CMakePackageConfigHelpers)
# Dependencies of the headers and of those library modules that have dependencies to be found.
string(JOIN " " cslf_package_vtk_components
  CommonCore CommonDataModel CommonExecutionModel
  FiltersExtraction FiltersGeneral FiltersGeometry FiltersModeling FiltersSources
  ImagingCore IOCore IOExport IOImage ParallelCore
  RenderingCore RenderingOpenGL2)
if (TARGET VTK::ParallelMPI)
  string(APPEND cslf_package_vtk_components " ParallelMPI")
endif ()
if (TARGET VTK::DomainsChemistry)
  string(APPEND cslf_package_vtk_components " DomainsChemistry")
endif ()
set(cslf_cmake_destination "${CMAKE_INSTALL_LIBDIR}/cmake/CSLF")
set(cslf_cmake_build_directory "${CMAKE_BINARY_DIR}/${cslf_cmake_destination}")
configure_package_config_file(
  "${CMAKE_CURRENT_SOURCE_DIR}/CMake/CSLFConfig.cmake.in"
  "${cslf_cmake_build_directory}/CSLFConfig.cmake"
  INSTALL_DESTINATION "${cslf_cmake_destination}")
write_basic_package_version_file(
  "${cslf_cmake_build_directory}/CSLFConfigVersion.cmake"
  VERSION "${PROJECT_VERSION}"
  COMPATIBILITY SameMinorVersion)
install(
  FILES
    "${cslf_cmake_build_directory}/CSLFConfig.cmake"
    "${cslf_cmake_build_directory}/CSLFConfigVersion.cmake"
  DESTINATION "${cslf_cmake_destination}")
