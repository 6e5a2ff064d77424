# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Finds all dependencies of CSLF.

# ParaView has its own VTK, which must be found before any other.
if (CSLF_BUILD_PARAVIEW_PLUGIN)
  find_package(ParaView 5.11 REQUIRED COMPONENTS RemotingCore RemotingServerManager RemotingViews)
endif ()
set(cslf_vtk_components
  CommonCore CommonDataModel CommonExecutionModel CommonMath CommonTransforms
  FiltersCore FiltersExtraction FiltersGeneral FiltersGeometry FiltersModeling
  FiltersSources
  ImagingCore ImagingGeneral
  IOCore IOExport IOImage IOXML
  ParallelCore
  RenderingCore RenderingOpenGL2 RenderingVolume png jpeg vtksys)
# The tool and the tests.
if (NOT CSLF_BUILD_PARAVIEW_PLUGIN)
  list(APPEND cslf_vtk_components
    CommonColor CommonMisc
    FiltersModeling
    ImagingColor ImagingStatistics ImagingStencil
    InteractionStyle InteractionWidgets
    IOGeometry IOLegacy IOPLY IOXMLParser
    RenderingAnnotation RenderingFreeType RenderingUI)
endif ()
if (CSLF_BUILD_TESTING AND NOT CSLF_BUILD_PARAVIEW_PLUGIN)
  list(APPEND cslf_vtk_components
    ChartsCore RenderingContextOpenGL2 RenderingVolumeOpenGL2 TestingCore TestingRendering ViewsContext2D)
endif ()
if (CSLF_WRAP_PYTHON)
  list(APPEND cslf_vtk_components WrappingPythonCore WrappingTools)
  find_package(Python3 REQUIRED COMPONENTS Interpreter Development.Module)
endif ()
find_package(VTK 9.1 REQUIRED
  COMPONENTS ${cslf_vtk_components}
  # VTK's OpenGL loader: opengl and glew up to 9.3, glad since. MPI, for several processes at once.
  # Chemistry, for molecules in a renderer's scene, and how they are drawn in the tests. Implicit
  # arrays, which are a module of their own in some versions, for the tests.
  OPTIONAL_COMPONENTS opengl glew glad ParallelMPI DomainsChemistry DomainsChemistryOpenGL2
    RenderingLOD CommonImplicitArrays)

# Up to VTK 9.3, a build for X aborts the process if there is no X server.
set(cslf_vtk_needs_x_server OFF)
if (VTK_VERSION VERSION_LESS 9.4 AND UNIX AND NOT APPLE)
  set(cslf_vtk_needs_x_server ON)
endif ()
if (cslf_vtk_needs_x_server AND CSLF_BUILD_APPLICATIONS AND NOT CSLF_BUILD_PARAVIEW_PLUGIN)
  find_package(X11 REQUIRED)
endif ()

if (CSLF_ENABLE_SAMPLER)
  find_package(embree 3 QUIET)
  if (NOT embree_FOUND)
    find_package(embree 4 REQUIRED)
  endif ()
endif ()
# GLU, which fills polygons. It needs no OpenGL for that.
find_package(OpenGL REQUIRED)
if (NOT TARGET OpenGL::GLU)
  message(FATAL_ERROR "GLU is missing. On Debian, it is the package libglu1-mesa-dev.")
endif ()
find_package(glm REQUIRED)
find_package(meshoptimizer REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(nlohmann_json REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(FFMPEG REQUIRED IMPORTED_TARGET
  libavformat libavcodec libavutil)
if (CSLF_ENABLE_SAMPLER)
  # Not by OpenImageIO's own CMake files: Debian's need the tools and the headers of an OpenCV.
  pkg_check_modules(OpenImageIO REQUIRED IMPORTED_TARGET OpenImageIO)
endif ()
