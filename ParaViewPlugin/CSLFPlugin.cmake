# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Builds the plugin from the top level, and the Python package for ParaView's Python.
paraview_plugin_scan(
  PLUGIN_FILES "${CMAKE_CURRENT_SOURCE_DIR}/ParaViewPlugin/paraview.plugin"
  PROVIDES_PLUGINS cslf_plugins
  ENABLE_BY_DEFAULT ON
  HIDE_PLUGINS_FROM_CACHE ON)
paraview_plugin_build(
  PLUGINS ${cslf_plugins}
  LIBRARY_SUBDIRECTORY "${PARAVIEW_PLUGIN_SUBDIR}"
  INSTALL_HEADERS OFF)

set(cslf_library_destination "${CMAKE_INSTALL_LIBDIR}/${PARAVIEW_PLUGIN_SUBDIR}/CSLFPlugin")
if (CSLF_WRAP_PYTHON)
  add_subdirectory(Python)
endif ()
if (CSLF_BUILD_TESTING AND CSLF_ENABLE_ENCODER)
  enable_testing()
  add_subdirectory(ParaViewPlugin/Testing)
endif ()
