#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Regenerates every table and figure of Documentation/evaluation, also on a bare Debian 12. It
# builds, samples, codes, draws and measures, and writes a page with plots, contact sheets and the
# JSON behind them. Results are kept in the folder `parts` and used again. Remove this folder to
# measure again. Run nothing else at the same time.
#
# usage: evaluate.sh [--quick] [--scenes NAME,...] [STUDY...]
#   --quick   use small fields, take some minutes and write to build/evaluation-quick;
#             without it, about two hours, to Documentation/evaluation
#   --scenes  compare these scenes, of those that cslf scenes lists or the dragon, in the studies
#             corpus, sampling, sizes, key-views and integrators, and write to
#             build/evaluation-scenes
#   STUDY     some of: corpus sampling scaling sizes novel-views key-views frame-rates integrators
#             cycles limits
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

packages=(python3-matplotlib python3-pil)
case " $* " in
  *" cycles "* | "  " | " --quick ") packages+=(python3-numpy python3-openimageio blender) ;;
esac
cslf_install "${cslf_packages[@]}" "${packages[@]}"
cslf_build cslf cslf-lab vtkCSLFPython
exec xvfb-run --auto-servernum --server-args="-screen 0 1280x1024x24 -noreset" \
  /usr/bin/python3 "$source/Utilities/evaluation/evaluate.py" --source "$source" \
  --build "$build" "$@"
