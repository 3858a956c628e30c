#!/usr/bin/env bash
# check_systems.sh [--command COMMAND] [--ccache] [SYSTEM...]: runs COMMAND (`scripts/test.sh unit`) in a clone of what is
# committed, on a fresh minimal root of each SYSTEM, as on a newcomer's machine. Prints one line for each; the exit status is 1
# if the command failed on any. Needs root and debootstrap. SYSTEM is of these, by default all:
#
# bullseye, bookworm, trixie: Debian 11, 12 and 13.
# bullseye-g++-9: Debian 11 with g++ 9 and CMake 3.16, the nearest to Ubuntu 20.04.
#
# --ccache: with the compiler's results of the run before, for those who check often. Roots, packages and logs are kept in
# $XDG_CACHE_HOME/cabinet_articulation/systems. Debian's mirror is that of this machine, or MIRROR.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cache=${XDG_CACHE_HOME:-$HOME/.cache}/cabinet_articulation/systems
command='scripts/test.sh unit'
ccache=false
systems=()

refuse() {
  echo "$1" >&2
  exit 2
}

while [ $# -gt 0 ]; do
  case $1 in
    --command)
      command=${2:?"--command needs a command"}
      shift
      ;;
    --ccache) ccache=true ;;
    bullseye | bookworm | trixie | bullseye-g++-9) systems+=("$1") ;;
    *) refuse "expected bullseye, bookworm, trixie or bullseye-g++-9, not '$1'; usage: check_systems.sh [--command COMMAND] [--ccache] [SYSTEM...]" ;;
  esac
  shift
done
[ ${#systems[@]} -gt 0 ] || systems=(bullseye bookworm trixie bullseye-g++-9)
[ "$(id -u)" -eq 0 ] || refuse "a root file system can be made by root only: run it with sudo"
[ -x "$(command -v debootstrap)" ] || refuse "debootstrap is missing: apt-get install debootstrap"

mirror=${MIRROR:-$(cat /etc/apt/sources.list /etc/apt/sources.list.d/* 2>/dev/null |
  awk '/^(URIs:|deb )/ { for (i = 2; i <= NF; ++i) if ($i ~ "^https?://.*/debian/?$") print $i }' | head -n 1)} || true
mirror=${mirror:-http://deb.debian.org/debian}

# A minimal root of a suite of Debian, with what the network of this machine asks for.
base_root() {
  local suite=$1 base=$cache/base-$1
  [ -d "$base" ] && return
  rm -rf "$base.new"
  debootstrap --variant=minbase --include=ca-certificates,git "$suite" "$base.new" "$mirror" || return 1
  echo force-unsafe-io >"$base.new/etc/dpkg/dpkg.cfg.d/throwaway"
  apt-config dump | grep -iE '^Acquire::(https?::|Check-)' >"$base.new/etc/apt/apt.conf.d/90network" || true
  cp -r /usr/local/share/ca-certificates/. "$base.new/usr/local/share/ca-certificates/" 2>/dev/null || true
  cp /etc/ssl/certs/ca-certificates.crt "$base.new/etc/ssl/certs/" 2>/dev/null || true
  mv "$base.new" "$base"
}

# What the shell in the root does before the command.
preparation() {
  echo 'cd /home/cabinet_articulation'
  if $ccache; then
    echo 'apt-get update -q && apt-get install -y -q --no-install-recommends ccache'
    echo 'export CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_DIR=/var/cache/ccache'
  fi
  if [[ $1 == *-g++-9 ]]; then
    echo 'scripts/install_dependencies.sh'
    echo 'apt-get install -y -q --no-install-recommends g++-9 python3-pip'
    echo 'pip3 install --quiet --target /opt/cmake "cmake==3.16.*"'
    # Scripts put /usr/bin first.
    echo 'printf "#!/bin/sh\nexec /opt/cmake/cmake/data/bin/cmake \"\$@\"\n" >/usr/bin/cmake.new'
    echo 'chmod +x /usr/bin/cmake.new && mv /usr/bin/cmake.new /usr/bin/cmake'
    echo 'export CC=gcc-9 CXX=g++-9'
  fi
}

# In a mount and process namespace of its own: at its end, mounts and processes are gone.
run_in() {
  local system=$1 fresh=$2
  unshare --mount --pid --fork bash -euo pipefail -s "$fresh" "$cache" "$system" <<'END'
mount -t proc proc "$1/proc"
mount --rbind /dev "$1/dev"
mount --rbind /sys "$1/sys"
mkdir -p "$1/var/cache/ccache" "$2/packages-${3%%-*}" "$2/ccache-$3"
mount --bind "$2/packages-${3%%-*}" "$1/var/cache/apt/archives"
mount --bind "$2/ccache-$3" "$1/var/cache/ccache"
exec env -i HOME=/root TERM=dumb DEBIAN_FRONTEND=noninteractive PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
  $(env | grep -iE '^(http|https|no)_proxy=' || true) chroot "$1" bash -e /home/run
END
}

check() {
  local system=$1 suite=${1%%-*} log=$cache/$1.log start=$SECONDS fresh status=0
  fresh=$(mktemp -d "$cache/run.XXXX")
  {
    base_root "$suite" && cp -a "$cache/base-$suite/." "$fresh/" && cp /etc/resolv.conf /etc/hosts "$fresh/etc/" &&
      git clone -q "$root" "$fresh/home/cabinet_articulation" &&
      { preparation "$system" && echo "$command"; } >"$fresh/home/run" && run_in "$system" "$fresh"
  } >"$log" 2>&1 || status=$?
  rm -rf --one-file-system "$fresh"
  local seconds=$((SECONDS - start)) result
  result=$(grep -E '^[0-9]+ passed, [0-9]+ failed$' "$log" | tail -n 1)
  [ $status -eq 0 ] && result=${result:-passed} || result="FAILED${result:+, $result}; see $log"
  echo "$system: $result, in $((seconds / 60)) min $((seconds % 60)) s"
  return $status
}

mkdir -p "$cache"
status=0
for system in "${systems[@]}"; do
  check "$system" || status=1
done
exit $status
