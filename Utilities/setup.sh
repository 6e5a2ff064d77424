#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Sourced by the scripts beside it: installs what CSLF needs on a bare Debian, and builds it.
#   cslf_install PACKAGE...    installs the Debian packages that are missing, such as those of the
#                              lists cslf_library_packages, cslf_packages and cslf_test_packages
#   cslf_build [TARGET...]     configures and builds the preset "release"
# Sets `source`, the source folder, and `build`, the build folder.

source="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
build="$source/build/release"

# The dependencies of the library and its Python modules, and a display for tests.
cslf_library_packages=(
  cmake g++ ninja-build pkg-config
  libvtk9-dev libpython3-dev python3
  libeigen3-dev libembree-dev libglu1-mesa-dev libmeshoptimizer-dev libopenimageio-dev libglm-dev nlohmann-json3-dev zlib1g-dev
  libavcodec-dev libavformat-dev libavutil-dev
  xauth xvfb)

# The dependencies of the library, the tool and the Python package.
cslf_packages=("${cslf_library_packages[@]}" python3-vtk9 libcli11-dev)

# What only the tests need.
cslf_test_packages=(
  dpkg-dev file  # for the test of the Debian package
  ffmpeg python3-numpy  # for the test of the independent reader
  qemu-user  # for the test of other processors
  chromium chromium-driver node-typescript python3-selenium)  # for those of pages

cslf_is_installed()
{
  [ "$(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

cslf_as_root()
{
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  else
    sudo "$@"
  fi
}

cslf_install()
{
  local package
  local -a missing=()
  for package in "$@"; do
    cslf_is_installed "$package" || missing+=("$package")
  done
  if [ "${#missing[@]}" -eq 0 ]; then
    return
  fi
  echo "Installing ${missing[*]}"
  cslf_as_root apt-get update --quiet
  cslf_as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install --quiet --yes --no-install-recommends "${missing[@]}"
}

cslf_build()
{
  local -a targets=()
  if [ "$#" -gt 0 ]; then
    targets=(--target "$@")
  fi
  (cd "$source" && cmake --preset release && cmake --build --preset release "${targets[@]}")
}
