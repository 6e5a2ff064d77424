#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Kills runs of the cslf tool at random moments, restarts each, and compares the result with that of
# an uninterrupted run.
#
# usage: measure-restart.sh CSLF KILLS FOLDER ARGUMENT...
#   CSLF         the tool
#   KILLS        the number of runs to kill, each once
#   FOLDER       working folder
#   ARGUMENT...  the command whose output is written, without -o, for instance
#                sample cornell-box -M 9 -N 64 --spp 64
# CSLF_SEED seeds the random moments (default 1), CSLF_EXTENSION names the container (default mp4).
set -euo pipefail

cslf="$1"
kills="$2"
folder="$3"
shift 3
extension="${CSLF_EXTENSION:-mp4}"
RANDOM="${CSLF_SEED:-1}"

mkdir -p "$folder"
reference="$folder/reference.$extension"
file="$folder/killed.$extension"
rm -rf "$reference" "$file" "$reference.partial" "$file.partial"

milliseconds()
{
  date +%s%3N
}

begin="$(milliseconds)"
"$cslf" "$@" -o "$reference" > "$folder/log.txt"
length="$(($(milliseconds) - begin))"
echo "uninterrupted: $length ms"

interrupted=0
for ((kill = 1; kill <= kills; ++kill)); do
  rm -f "$file"
  moment="$((length * RANDOM / 32768))"
  "$cslf" "$@" -o "$file" > "$folder/log.txt" &
  process="$!"
  sleep "$((moment / 1000)).$(printf '%03d' "$((moment % 1000))")"
  builtin kill -KILL "$process" 2> /dev/null || true
  wait "$process" 2> /dev/null || true
  # A run that was killed too late had finished. It tests nothing, but does no harm.
  if [ ! -e "$file" ]; then
    interrupted="$((interrupted + 1))"
  fi
  # A run that is killed at once leaves no folder.
  parts="$( (find "$file.partial" -name '*.part' 2> /dev/null || true) | wc -l)"
  begin="$(milliseconds)"
  "$cslf" "$@" -o "$file" > "$folder/log.txt" 2> "$folder/errors.txt"
  echo "kill $kill: after $moment ms, $parts parts left, restart took $(($(milliseconds) - begin)) ms"
  if [ -s "$folder/errors.txt" ]; then
    cat "$folder/errors.txt" >&2
    exit 1
  fi
  if ! cmp "$file" "$reference"; then
    echo "The bytes differ after kill $kill." >&2
    exit 1
  fi
  if [ -e "$file.partial" ]; then
    echo "Kill $kill left $file.partial." >&2
    exit 1
  fi
done
echo "$kills kills, $interrupted of unfinished runs: all files equal"
