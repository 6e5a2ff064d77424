#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Shows CSLF from end to end, also on a bare Debian: samples the Cornell box and the Stanford
# dragon into videos, draws novel views with every lookup and compares them with path-traced ones,
# and makes a page for browsers. Fields from an earlier run are used again.
#
# usage: demo.sh [folder]    writes the results to the folder, build/demo by default
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

folder="${1:-$source/build/demo}"
viewpoints=9
resolution=128

cslf_install "${cslf_packages[@]}"
cslf_build cslf
mkdir -p "$folder"
cslf="$build/bin/cslf"

# Windows need an X server, also off screen.
with_display()
{
  xvfb-run --auto-servernum --server-args="-screen 0 1280x1024x24" "$@"
}

# demo NAME TITLE SCENE...: one scene, from sampling to figures.
demo()
{
  local name="$1" title="$2"
  shift 2
  echo
  echo "$title"
  if [ ! -e "$folder/$name.mp4" ]; then
    "$cslf" sample "$@" -M "$viewpoints" -N "$resolution" -o "$folder/$name.mp4"
  fi
  "$cslf" info "$folder/$name.mp4"
  with_display "$cslf" evaluate "$folder/$name.mp4" "$@" --views 3 --size 256 --spp 256 \
    --title "$title" --contact-sheet "$folder/$name.png" | tee "$folder/$name.txt"
}

demo cornell-box "Cornell box" cornell-box
demo dragon "Stanford dragon" "$source/Testing/Data/dragon.ply" \
  --environment gradient --roughness 0.3 --metallic 1 --base-color 0.95 0.8 0.5
with_display "$cslf" export "$folder/cornell-box.mp4" -o "$folder/cornell-box.html"
"$cslf" sheet "$folder/cornell-box.png" "$folder/dragon.png" -o "$folder/contact-sheet.png"

echo
echo "Path-traced and looked-up views, side by side: $folder/contact-sheet.png"
echo "A page for browsers: $folder/cornell-box.html"
echo "The dragon is the Stanford Computer Graphics Laboratory's (Stanford 3D Scanning Repository)."
if [ -n "${DISPLAY:-}" ]; then
  "$cslf" view "$folder/cornell-box.mp4"
fi
