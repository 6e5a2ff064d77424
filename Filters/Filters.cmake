# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Names the filters' classes and sources for Module/CMakeLists.txt.
list(APPEND classes
  ../Filters/vtkCSLFFieldQuality
  ../Filters/vtkCSLFImageQuality
  ../Filters/vtkCSLFImageReader
  ../Filters/vtkCSLFImageWriter)
list(APPEND sources
  ../Filters/CubeMaps/cslfCubeMapFiles.cxx
  ../Filters/Pipeline/cslfSlabs.cxx)
list(APPEND private_headers
  ../Filters/CubeMaps/cslfCubeMapFiles.h
  ../Filters/Pipeline/cslfSlabs.h
  ../Filters/Quality/cslfPSNR.h)
