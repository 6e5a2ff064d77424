# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Names the mapper's classes, sources and shaders for Module/CMakeLists.txt.
list(APPEND sources
  ../Rendering/cslfLookup.cxx)
list(APPEND private_headers
  ../Rendering/cslfLookup.h)
