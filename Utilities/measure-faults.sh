#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Writes every kind of output while each single call to the file system fails in turn, and while the
# process is killed at random times. Each time the next run must write the right bytes. Prints the
# number of failures of each kind, and the seconds. Takes about a quarter of an hour.
#
# usage: measure-faults.sh BUILD FOLDER [ARGUMENT...]
#   BUILD        the build folder, with tests
#   FOLDER       working folder, emptied first
#   ARGUMENT...  for Testing/Faults/run_faults.py, such as --kills 1000 --seed 2
set -euo pipefail

build="$1"
folder="$2"
shift 2
here="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
faults="$(find "$build" -name 'libcslfFaults.so' | head -n 1)"
"$here/Testing/Faults/run_faults.py" "$build/bin/cslf" "$faults" "$folder" "$@"
"$here/Testing/Faults/run_faults.py" "$build/bin/cslf" "$faults" "$folder" --disk
