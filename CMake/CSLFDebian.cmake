# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# The Debian package: `cpack -G DEB` in the build folder makes cslf_VERSION_ARCHITECTURE.deb, with
# library, headers, CMake package, tool and Python package.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME cslf)
set(CPACK_PACKAGE_VENDOR "CSLF contributors")
set(CPACK_PACKAGE_CONTACT "CSLF contributors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Cube surface light fields for VTK")
set(CPACK_PACKAGE_DESCRIPTION
  "Samples what can be seen of a scene from anywhere outside a cube by path tracing with cached
radiance, codes it as video, and draws it in any VTK scene at a cost that does not depend on the
scene. Library, headers, the tool cslf and the Python package cslf.")
set(CPACK_RESOURCE_FILE_LICENSE "${CSLF_SOURCE_DIR}/LICENSE")
set(CPACK_PACKAGING_INSTALL_PREFIX "/usr")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
# What the files are linked with, by dpkg-shlibdeps; ldconfig runs after the installation.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-vtk9")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libvtk9-dev")
include(CPack)
