#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Makes the pictures of Documentation/ParaView.md: starts ParaView off screen, with the plugin built
# by build_paraview_plugin.sh, and takes pictures of its window.
#
# usage: screenshot_paraview.sh [picture...]    all by default: sampler field save open reader
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

images="$source/Documentation/images"
state="$source/build/screenshots"
folder="/tmp/CSLF" # visible in a dialog

# Keyboard and mouse actions. Positions are those in a window of 1280 x 960.
drag()
{
  xdotool mousemove "$1" "$2" sleep 1 mousedown 1 sleep 1 \
    mousemove "$((($1 + $3) / 2))" "$((($2 + $4) / 2))" sleep 1 mousemove "$3" "$4" sleep 1 \
    mouseup 1 sleep 2
}

click()
{
  xdotool mousemove "$1" "$2" sleep 0.5 click 1 sleep 2
}

wait_for_window()
{
  timeout 120 xdotool search --sync --onlyvisible --name "$1" >/dev/null
  sleep 5
}

# Makes the panels wider and higher than by default.
arrange_window()
{
  local window
  window="$(xdotool search --onlyvisible --name "^ParaView")"
  xdotool windowsize --sync "$window" 1278 936 sleep 2
  drag 295 700 430 700
  drag 148 433 148 310
  xdotool windowfocus "$window"
}

open_dialog()
{
  case "$1" in
    save)
      xdotool key ctrl+s
      wait_for_window "^Save File"
      xdotool type another.mp4
      xdotool key Return
      wait_for_window "^Configure Writer"
      ;;
    open)
      xdotool key ctrl+o
      wait_for_window "^Open File"
      click 520 341
      ;;
    reader)
      click 142 325
      ;;
  esac
}

# take PICTURE: runs in an X server. The Python script sets up the window.
take()
{
  local paraview
  rm -f "$state/ready"
  openbox &
  CSLF_PICTURE="$1" CSLF_READY="$state/ready" \
    paraview --dr --script="$source/Utilities/screenshot_paraview.py" &
  paraview=$!
  until [ -e "$state/ready" ]; do
    kill -0 "$paraview"
    sleep 1
  done
  sleep 5
  arrange_window
  open_dialog "$1"
  sleep 5
  import -window root +dither -colors 128 -strip "PNG8:$images/paraview-$1.png"
  kill -KILL "$paraview"
}

if [ "${1:-}" = --inside ]; then
  cd "$folder"
  take "$2"
  exit
fi

cslf_install imagemagick libqt5svg5 openbox xdotool
export HOME="$state/home"
mkdir -p "$images" "$HOME" "$folder"
export PYTHONPATH="$source/build/paraview-sdk/usr/lib/python3/dist-packages"
PV_PLUGIN_PATH="$(echo "$source"/build/paraview/lib/paraview-*/plugins)"
export PV_PLUGIN_PATH
if [ "$#" -eq 0 ]; then
  set -- sampler field save open reader
fi
for picture in "$@"; do
  echo "Taking $images/paraview-$picture.png"
  xvfb-run --auto-servernum --server-args="-screen 0 1280x960x24" \
    "${BASH_SOURCE[0]}" --inside "$picture" >"$state/$picture.log" 2>&1
done
