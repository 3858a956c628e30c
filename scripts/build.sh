#!/usr/bin/env bash
# Installs what is missing and builds the package in build/, for use from devel/: build.sh [MAKE TARGETS].
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/ros_environment.sh"
build=$root/build

# rosrun never looks into a package's build/, so the programs go to devel/ beside it.
mkdir -p "$build"
[ -e "$build/devel" ] || ln -s ../devel "$build/devel"
configure "$build" "$root/devel"
make -C "$build" -j"$(nproc)" --no-print-directory all "$@"
