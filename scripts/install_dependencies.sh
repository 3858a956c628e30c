#!/usr/bin/env bash
# Installs what building, testing and running needs: Debian's own packages on Debian 11 to 13 and Ubuntu 22.04 and 24.04 (there
# from universe), rosdep on Ubuntu 20.04 with ROS Noetic.
# Does nothing when everything is there. Uses sudo when not root.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. /etc/os-release

as_root() { if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi; }

# All of these systems know all of these names.
debian_packages=(
  # compilers and test tools
  g++ make cmake libgtest-dev libgmock-dev python3-pytest catkin catkin-lint git ca-certificates
  # ROS 1; the ros-*-msgs packages hold the .msg files that the message generator needs
  libroscpp-dev rosbash python3-roslaunch python3-roswtf python3-rosnode python3-rosservice python3-rosmsg python3-rostopic
  librostest-dev python3-rostest libroslib-dev
  libnodelet-dev libnodeletlib-dev libnodeletlib-tools pluginlib-dev
  libtf2-ros-dev libtf2-eigen-dev libtf2-geometry-msgs-dev libtf2-msgs-dev tf2-tools
  libmessage-filters-dev libcv-bridge-dev libimage-transport-dev libimage-geometry-dev
  libcamera-calibration-parsers-dev
  libstereo-image-proc-dev ros-stereo-image-proc
  ros-robot-state-publisher joint-state-publisher
  librosbag-dev python3-rosbag libdiagnostic-updater-dev libdynamic-reconfigure-config-init-mutex-dev
  python3-dynamic-reconfigure
  # RViz and what a plugin for it needs, and a display to test it on; Debian 11's librviz-dev forgets libopengl-dev
  rviz librviz-dev libopengl-dev qtbase5-dev xvfb libgl1-mesa-dri
  # for rostopic echo
  python3-diagnostic-msgs python3-sensor-msgs python3-geometry-msgs python3-std-msgs python3-stereo-msgs
  python3-visualization-msgs python3-tf2-msgs
  ros-message-generation ros-message-runtime ros-std-msgs ros-geometry-msgs ros-sensor-msgs ros-stereo-msgs
  ros-visualization-msgs ros-diagnostic-msgs ros-std-srvs ros-tf2-msgs libstd-srvs-dev python3-std-srvs
  libvisualization-msgs-dev libstereo-msgs-dev libsensor-msgs-dev libgeometry-msgs-dev libstd-msgs-dev libdiagnostic-msgs-dev
  # libraries; TinyXML or TinyXML-2 comes with urdfdom, which hands out its documents
  libpcl-dev libopencv-dev libeigen3-dev libceres-dev libyaml-cpp-dev liburdfdom-dev
  # benchmarks, the figures of the evaluation, and images in tests
  libbenchmark-dev python3-matplotlib python3-pil
)

# Plugins for compressed images, which Debian has from 13 on, and the points of depth cameras in RViz.
optional_packages=(
  libdepth-image-proc-dev
  ros-compressed-image-transport ros-compressed-image-transport-dev
  ros-compressed-depth-image-transport ros-compressed-depth-image-transport-dev
)

not_installed() {
  local package
  for package in "$@"; do
    [ "$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null)" = "install ok installed" ] || echo "$package"
  done
}

install_debian() {
  local missing package
  mapfile -t missing < <(not_installed "${debian_packages[@]}")
  [ ${#missing[@]} -eq 0 ] || as_root apt-get update -q
  for package in $(not_installed "${optional_packages[@]}"); do
    if apt-cache show "$package" >/dev/null 2>&1; then missing+=("$package"); fi
  done
  [ ${#missing[@]} -eq 0 ] && return
  echo "installing ${#missing[@]} packages"
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${missing[@]}"
}

install_noetic() {
  if [ ! -d /opt/ros/noetic ]; then
    echo "expected ROS Noetic in /opt/ros/noetic; see http://wiki.ros.org/noetic/Installation/Ubuntu" >&2
    exit 1
  fi
  as_root apt-get update -q
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends \
    g++ make cmake libgtest-dev libgmock-dev python3-pytest python3-rosdep python3-catkin-lint \
    ros-noetic-compressed-image-transport ros-noetic-compressed-depth-image-transport xvfb libgl1-mesa-dri
  [ -d /etc/ros/rosdep/sources.list.d ] || as_root rosdep init
  rosdep update --include-eol-distros --rosdistro noetic
  rosdep install --from-paths "$here/.." --ignore-src --rosdistro noetic -y
}

case "$ID-${VERSION_ID:-}" in
  debian-11 | debian-12 | debian-13 | ubuntu-22.04 | ubuntu-24.04) install_debian ;;
  ubuntu-20.04) install_noetic ;;
  *)
    echo "this script knows Debian 11, 12 and 13 and Ubuntu 20.04, 22.04 and 24.04, and this is $PRETTY_NAME;" \
      "install the dependencies of package.xml by rosdep" >&2
    exit 1
    ;;
esac
