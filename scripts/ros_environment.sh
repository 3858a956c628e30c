# To be sourced by scripts that build: installs what is missing, and makes ROS known to this shell.
#
# configure BUILD DEVEL CMAKE_ARGUMENT...: has CMake write the makefiles of this package into BUILD, with its devel space in
# DEVEL and its install space in BUILD/install; silent unless that fails.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# ROS's own scripts need the system's python3; another one first on PATH breaks them.
export PATH=/usr/bin:$PATH
"$root/scripts/install_dependencies.sh"
if [ -f /opt/ros/noetic/setup.sh ]; then
  set +u
  . /opt/ros/noetic/setup.sh
  set -u
fi

configure() {
  local build=$1 devel=$2
  shift 2
  # catkin sets the tests' PYTHONPATH when it configures, and leaves out what is not there yet.
  mkdir -p "$build" "$devel/lib/python3/dist-packages"
  # An earlier build that the shell has sourced is no part of what this one is built on, nor of its install space.
  local below=:${CMAKE_PREFIX_PATH:-}:
  below=${below//:$devel:/:}
  below=${below#:}
  if CMAKE_PREFIX_PATH=${below%:} cmake -S "$root" -B "$build" -DCATKIN_DEVEL_PREFIX="$devel" -DCMAKE_INSTALL_PREFIX="$build/install" \
    -DPYTHON_EXECUTABLE=/usr/bin/python3 "$@" >"$build/cmake.log" 2>&1; then
    return
  fi
  cat "$build/cmake.log"
  return 1
}
