# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# The Debian package: `cpack -G DEB` in the build folder makes cslf_VERSION_ARCHITECTURE.deb, with
# library, headers, CMake package, tool and Python package. To distribute it, add
# `-D CPACK_PACKAGE_CONTACT="NAME <ADDRESS>"`.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME cslf)
set(CPACK_PACKAGE_VENDOR "CSLF contributors")
set(CPACK_PACKAGE_CONTACT "CSLF contributors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Cube surface light fields for VTK")
set(CPACK_PACKAGE_DESCRIPTION
  "Bakes a scene into a light field by path tracing, codes it as video,
and draws it in any VTK scene at a cost that does not depend on the
scene. Library, headers, the tool cslf and the Python package cslf.")
set(CPACK_RESOURCE_FILE_LICENSE "${CSLF_SOURCE_DIR}/LICENSE")
set(CPACK_PACKAGING_INSTALL_PREFIX "/usr")
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_CURRENT_LIST_DIR}/stage.cmake")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA "${CMAKE_CURRENT_LIST_DIR}/triggers")
# The libraries that the files link to, found by dpkg-shlibdeps.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
if (CSLF_WRAP_PYTHON)
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3")
endif ()
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-vtk9")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libvtk9-dev, xvfb")
include(CPack)
