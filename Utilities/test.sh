#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Builds everything and runs all tests, also on a bare Debian. The arguments go to ctest, for
# instance `-R Decoder`. The last line says how many tests passed and failed.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

cslf_install "${cslf_packages[@]}"
cslf_build

report="$build/Testing/report.xml"
rm -f "$report"
status=0
# A server that restarts when its last client leaves would refuse a client that comes at that
# moment.
(cd "$source" && xvfb-run --auto-servernum --server-args="-screen 0 1280x1024x24 -noreset" \
  ctest --preset release --parallel 2 --output-junit "$report" "$@") || status=$?

# The attributes of the report's one <testsuite>.
count()
{
  grep --only-matching --max-count=1 "^[[:space:]]*$1=\"[0-9]*\"" "$report" | tr -dc '0-9'
}
failed="$(count failures)"
passed="$(($(count tests) - failed - $(count skipped) - $(count disabled)))"
echo "$passed passed, $failed failed"
exit "$status"
