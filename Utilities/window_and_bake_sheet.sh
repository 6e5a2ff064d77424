#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Draws small scenes in VTK's window next to their bakes, with the differences, on one sheet:
# Documentation/images/window-and-bake.png, or the given file. Needs the built preset "release".
#
# usage: window_and_bake_sheet.sh [file.png]
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT

xvfb-run --auto-servernum --server-args="-screen 0 1280x1024x24 -noreset" \
  "$build/bin/vtkCSLFCxxTests" TestCSLFSceneImporterSheet --sheet "$folder/sheet.png"
cp "$folder/sheet.png" "${1:-$source/Documentation/images/window-and-bake.png}"
