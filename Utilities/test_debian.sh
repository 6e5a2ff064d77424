#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Runs one of the README's commands as a newcomer would, in a bare Debian of another version: a
# system made by debootstrap that holds nothing but Debian's base and a copy of this checkout, with
# its uncommitted changes. Prints the command's output to a log, and at the end one line: the system,
# the job, and the last line of the command. Needs root, for chroot.
#
# usage: test_debian.sh SYSTEM [JOB [ARGUMENT...]]
#   SYSTEM     bookworm (Debian 12), trixie (13), forky (testing)
#   JOB        test (the default; with the argument --nightly all tests), plugin (ParaView's plugin and
#              its tests), demo, warnings (builds the preset "dev", to which warnings are errors)
#   ARGUMENT   for the command, such as `-R Decoder` for the tests
# With CCACHE_DIR set, the system has ccache too and keeps what it compiles in that folder.
#
# The systems are kept in build/debian/: SYSTEM.bare is copied for every run, SYSTEM holds the last
# run and what it built, SYSTEM.packages the packages that were downloaded, SYSTEM-JOB.log the log.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

fail()
{
  echo "test_debian.sh: $1" >&2
  exit 2
}

system="${1:-}"
job="${2:-test}"
case "$system" in
  bookworm | trixie | forky) ;;
  *) fail "the first argument must be bookworm, trixie or forky" ;;
esac
case "$job" in
  test) command='Utilities/test.sh "$@"' ;;
  plugin)
    command='Utilities/build_paraview_plugin.sh && set -o pipefail &&
      ctest --preset paraview "$@" | tee plugin.log && grep "tests passed" plugin.log'
    ;;
  demo) command='Utilities/demo.sh "$@"' ;;
  warnings)
    command='. Utilities/setup.sh && cslf_install "${cslf_packages[@]}" &&
      cmake --preset dev "$@" && cmake --build --preset dev -- -k 0'
    ;;
  *) fail "the second argument must be test, plugin, demo or warnings" ;;
esac
shift "$(($# < 2 ? $# : 2))"
[ "$(id -u)" -eq 0 ] || fail "chroot needs root"
cslf_install debootstrap
settings=(HOME=/root LANG=C.UTF-8 TERM=dumb PATH=/usr/sbin:/usr/bin:/sbin:/bin)
if [ -n "${CCACHE_DIR:-}" ]; then
  mkdir -p "$CCACHE_DIR"
  settings+=(CCACHE_DIR=/var/cache/ccache CMAKE_C_COMPILER_LAUNCHER=ccache
    CMAKE_CXX_COMPILER_LAUNCHER=ccache)
  command=". Utilities/setup.sh && cslf_install ccache && $command"
fi

folder="$source/build/debian"
root="$folder/$system"
packages="$folder/$system.packages"
log="$folder/$system-$job.log"
mkdir -p "$packages/partial"

if [ ! -e "$root.bare" ]; then
  # An older debootstrap does not know a newer testing, which is installed like unstable.
  script=/usr/share/debootstrap/scripts
  [ -e "$script/$system" ] && script="$script/$system" || script="$script/sid"
  rm -rf --one-file-system "$root.making"
  debootstrap --variant=minbase "$system" "$root.making" "" "$script" >"$log" 2>&1 ||
    fail "debootstrap failed, see $log"
  mv "$root.making" "$root.bare"
fi

rm -rf --one-file-system "$root"
cp --archive "$root.bare" "$root"
cp /etc/resolv.conf "$root/etc/"
# Debian's installer writes this file, debootstrap does not.
[ -e "$root/etc/hosts" ] || echo "127.0.0.1 localhost" >"$root/etc/hosts"
# The proxy settings and the like of this machine.
apt-config dump Acquire >"$root/etc/apt/apt.conf.d/10acquire"
# The system is temporary, so packages need not be safe from a power cut.
echo force-unsafe-io >"$root/etc/dpkg/dpkg.cfg.d/unsafe-io"
# No services are started in the system.
printf '#!/bin/sh\nexit 101\n' >"$root/usr/sbin/policy-rc.d"
chmod +x "$root/usr/sbin/policy-rc.d"
mkdir -p "$root/cslf"
(cd "$source" && git ls-files --cached --others --exclude-standard -z |
  tar --null --files-from=- --ignore-failed-read --create) |
  tar --extract --directory="$root/cslf" --no-same-owner

# The mounts end with their namespace.
export root packages command
status=0
unshare --mount --propagation private bash -c '
  set -e
  for point in proc sys dev; do
    mount --rbind "/$point" "$root/$point"
  done
  mount --bind "$packages" "$root/var/cache/apt/archives"
  if [ -n "${CCACHE_DIR:-}" ]; then
    mkdir -p "$root/var/cache/ccache"
    mount --bind "$CCACHE_DIR" "$root/var/cache/ccache"
  fi
  exec env -i "$@"' bash "${settings[@]}" \
  chroot "$root" bash -c "cd /cslf && $command" bash "$@" >"$log" 2>&1 || status=$?
echo "$system $job: $(tail -n 1 "$log")"
exit "$status"
