# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Everything CSLF is built from, found in one place.
set(cslf_vtk_components
  ChartsCore
  CommonColor CommonCore CommonDataModel CommonExecutionModel CommonMisc CommonTransforms
  FiltersCore FiltersExtraction FiltersGeneral FiltersGeometry FiltersModeling FiltersSources
  ImagingColor ImagingCore ImagingGeneral ImagingStatistics ImagingStencil
  InteractionStyle InteractionWidgets
  IOGeometry IOImage IOPLY IOXML
  ParallelCore
  RenderingAnnotation RenderingContextOpenGL2 RenderingCore RenderingFreeType RenderingOpenGL2 RenderingUI
  ViewsContext2D opengl vtksys)
if (CSLF_BUILD_TESTING)
  list(APPEND cslf_vtk_components TestingCore TestingRendering)
endif ()
if (CSLF_WRAP_PYTHON)
  list(APPEND cslf_vtk_components WrappingPythonCore WrappingTools)
  find_package(Python3 REQUIRED COMPONENTS Interpreter Development.Module)
endif ()
find_package(VTK 9.1 REQUIRED
  COMPONENTS ${cslf_vtk_components}
  # VTK's OpenGL loader: glew up to 9.3, glad since. MPI, for several processes at once.
  OPTIONAL_COMPONENTS glew glad ParallelMPI)

find_package(embree 3 QUIET)
if (NOT embree_FOUND)
  find_package(embree 4 REQUIRED)
endif ()
find_package(glm REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(FFMPEG REQUIRED IMPORTED_TARGET
  libavformat libavcodec libavutil libswscale)
# Not by its own CMake files: Debian's want the tools and the headers of an OpenCV installed.
pkg_check_modules(OpenImageIO REQUIRED IMPORTED_TARGET OpenImageIO)
