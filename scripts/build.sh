#!/usr/bin/env bash
# Installs what is missing and builds the package in build/, for use from devel/: build.sh [MAKE TARGETS].
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(dirname "$here")
build=$root/build

# ROS's own scripts need the system's python3; another one first on PATH breaks them.
export PATH=/usr/bin:$PATH
"$here/install_dependencies.sh"
if [ -f /opt/ros/noetic/setup.sh ]; then
  set +u
  . /opt/ros/noetic/setup.sh
  set -u
fi
# rosrun never looks into a package's build/, so the programs go to devel/ beside it.
# catkin sets the tests' PYTHONPATH when it configures, and leaves out what is not there yet.
mkdir -p "$build" "$root/devel/lib/python3/dist-packages"
[ -e "$build/devel" ] || ln -s ../devel "$build/devel"
cmake -S "$root" -B "$build" -DCATKIN_DEVEL_PREFIX="$root/devel" -DPYTHON_EXECUTABLE=/usr/bin/python3 \
  >"$build/cmake.log" 2>&1 || { cat "$build/cmake.log"; exit 1; }
make -C "$build" -j"$(nproc)" --no-print-directory all "$@"
