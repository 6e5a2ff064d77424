#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Draws the scenes that cslf lists on one sheet: Documentation/images/scenes.png, or the given file.
# Needs the built preset "release".
#
# usage: scene_pictures.sh [file.png]
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

cslf="$build/bin/cslf"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT

pictures=()
for name in $("$cslf" scenes | cut -d ' ' -f 1); do
  case "$name" in
    cornell-box) camera=(--position 0.7 0.5 4.6) ;;
    terrain) camera=(--position 505500 4984000 10500 --view-up 0 0 1) ;;
    molecule) camera=(--position 30 55 110) ;;
    *) camera=() ;;
  esac
  pictures+=("$folder/$name.png")
  "$cslf" trace "$name" -o "$folder/$name.png" --background black \
    --size 240 240 --spp 64 --view-angle 36 "${camera[@]}"
done
"$cslf" sheet "${pictures[@]}" -o "${1:-$source/Documentation/images/scenes.png}" --columns 3
