#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Builds everything and runs the tests, also on a bare Debian. The last line says how many passed
# and failed.
#
# usage: test.sh [--nightly] [ARGUMENT...]
#   --nightly  also run the tests with this label
#   ARGUMENT   for ctest, for instance -R Decoder
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

cslf_install "${cslf_packages[@]}" "${cslf_test_packages[@]}"
cslf_build

tests=(--label-exclude nightly)
if [ "${1:-}" = --nightly ]; then
  tests=()
  shift
fi
report="$build/Testing/report.xml"
rm -f "$report"
status=0
# A server that restarts when its last client leaves would refuse a client that comes at that
# moment.
(cd "$source" && xvfb-run --auto-servernum --server-args="-screen 0 1280x1024x24 -noreset" \
  ctest --preset release --parallel 2 --output-junit "$report" "${tests[@]}" "$@") || status=$?

# The attributes of the report's one <testsuite>.
count()
{
  grep --only-matching --max-count=1 "^[[:space:]]*$1=\"[0-9]*\"" "$report" | tr -dc '0-9'
}
failed="$(count failures)"
passed="$(($(count tests) - failed - $(count skipped) - $(count disabled)))"
echo "$passed passed, $failed failed"
exit "$status"
