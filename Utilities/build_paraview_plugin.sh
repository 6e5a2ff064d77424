#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Builds the ParaView plugin, also on a bare Debian. Test it with `ctest --preset paraview`. If
# ParaView_DIR is the CMake folder of an installed ParaView with its development files, the plugin
# is built for that one, and Debian's is not used.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

sdk="$source/build/paraview-sdk"

# ParaView's development files and Python package, with links to the rest. Up to Debian 13, the Python
# package cannot be installed beside that of Debian's VTK. Since Debian 13, the names of its modules
# contain Python's version, but ParaView's CMake files name them without it.
unpack_sdk()
{
  local version file
  version="$(dpkg-query --show --showformat='${Version}' paraview)"
  if [ "$(cat "$sdk/version" 2>/dev/null)" = "$version" ]; then
    return
  fi
  echo "Unpacking ParaView's development files to $sdk"
  rm -rf "$sdk"
  mkdir -p "$sdk/packages"
  (cd "$sdk/packages" && apt-get download --quiet "paraview-dev=$version" "python3-paraview=$version")
  for file in "$sdk"/packages/*.deb; do
    dpkg-deb --extract "$file" "$sdk"
  done
  rm -r "$sdk/packages"
  dpkg --listfiles paraview | while read -r file; do
    if { [ ! -d "$file" ] || [ -L "$file" ]; } && [ ! -e "$sdk$file" ]; then
      mkdir -p "$(dirname "$sdk$file")"
      ln -s "$file" "$sdk$file"
    fi
  done
  find "$sdk" -name '*.cpython-*.so' | while read -r file; do
    ln -s "$(basename "$file")" "${file%%.cpython-*}.so"
  done
  echo "$version" >"$sdk/version"
}

# What the plugin needs, without the packages of the tool and its tests. ParaView itself needs many
# Python packages, on which Debian makes it depend.
cslf_install "${cslf_library_packages[@]}"
if [ -z "${ParaView_DIR:-}" ]; then
  cslf_install paraview libqt5svg5 python3-mpi4py python3-numpy openmpi-bin
  unpack_sdk
  ParaView_DIR="$(echo "$sdk"/usr/lib/*/cmake/paraview-*)"
fi
cd "$source"
cmake --preset paraview "-DParaView_DIR=$ParaView_DIR"
cmake --build --preset paraview
plugin="$(echo "$source"/build/paraview/lib/paraview-*/plugins/CSLFPlugin/CSLFPlugin.so)"
cat <<END

The plugin is built: $plugin
To load it in ParaView: Tools > Manage Plugins > Load New, with this file. Or start ParaView with it:
  PV_PLUGIN_PATH="$(dirname "$(dirname "$plugin")")" paraview
Then try Sources > CSLF and Filters > CSLF; Documentation/ParaView.md has the first steps.
END
