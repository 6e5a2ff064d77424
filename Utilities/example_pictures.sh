#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Makes the pictures of the examples, Documentation/images/example-*.png, with the Python examples,
# in their default sizes or larger ones. Needs the built preset "release".
#
# usage: example_pictures.sh [example...]    names of scripts without .py; all by default
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

export PYTHONPATH="${PYTHONPATH:-$build/lib/python3/dist-packages}"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT

if [ "$#" -eq 0 ]; then
  set -- hello_light_field isosurface molecule gltf_scene live_actors slabwise timed_bake \
    regression_fixture bake_window notebook
fi
for example in "$@"; do
  case "$example" in
    hello_light_field) arguments=(17 256 16) ;;
    timed_bake) arguments=(9 128 120) ;;
    regression_fixture) arguments=(--bake) ;;
    *) arguments=() ;;
  esac
  (cd "$folder" && xvfb-run --auto-servernum \
    /usr/bin/python3 "$source/Examples/Python/$example.py" "${arguments[@]}")
done
for picture in "$folder"/*.png; do
  cp "$picture" "$source/Documentation/images/example-$(basename "$picture")"
done
