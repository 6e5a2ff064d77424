#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Regenerates every table and figure of Documentation/evaluation, on a bare Debian 12 too: builds,
# samples, codes, draws and measures, and writes a page with plots and contact sheets and the JSON
# behind them. What has been measured into a folder is not measured again: remove its folder `parts`
# for that. Nothing else should run meanwhile.
#
# usage: evaluate.sh [--quick] [STUDY...]
#   --quick   small fields, within 10 minutes, into build/evaluation-quick; without it some 80
#             minutes, into Documentation/evaluation
#   STUDY     some of: sampling scaling sizes novel-views key-views frame-rates integrators cycles
#             limits
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

packages=(python3-matplotlib python3-pil)
case " $* " in
  *" cycles "* | "  " | " --quick ") packages+=(python3-numpy python3-openimageio blender) ;;
esac
cslf_install "${cslf_packages[@]}" "${packages[@]}"
cslf_build cslf vtkCSLFPython
exec xvfb-run --auto-servernum --server-args="-screen 0 1280x1024x24 -noreset" \
  /usr/bin/python3 "$source/Utilities/evaluation/evaluate.py" --source "$source" \
  --build "$build" "$@"
