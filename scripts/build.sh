#!/usr/bin/env bash
# Installs what is missing and builds the package: build.sh [FOLDER [tests]]. FOLDER is build/ unless given.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(dirname "$here")
build=${1:-$root/build}

# ROS's own scripts need the system's python3; another one first on PATH breaks them.
export PATH=/usr/bin:$PATH
"$here/install_dependencies.sh"
if [ -f /opt/ros/noetic/setup.sh ]; then
  set +u
  . /opt/ros/noetic/setup.sh
  set -u
fi
mkdir -p "$build"
cmake -S "$root" -B "$build" -DPYTHON_EXECUTABLE=/usr/bin/python3 >"$build/cmake.log" 2>&1 || { cat "$build/cmake.log"; exit 1; }
make -C "$build" -j"$(nproc)" --no-print-directory all ${2:-}
