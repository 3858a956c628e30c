#!/usr/bin/env bash
# check_workspace.sh: installs what is missing, and does what users of a catkin workspace do: catkin_make with this package and
# another one that uses it (test/downstream/kitchen_watcher), and catkin_make install. The other one then runs in the devel
# space and in the install space. Takes as long as building anew; the last line says how it went. The workspace stays in
# $XDG_CACHE_HOME/cabinet_articulation/workspace: in the source tree, ROS would find all files twice.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/ros_environment.sh"
workspace=${XDG_CACHE_HOME:-$HOME/.cache}/cabinet_articulation/workspace

mkdir -p "$workspace/src"
ln -sfn "$root" "$workspace/src/cabinet_articulation"
ln -sfn "$root/test/downstream/kitchen_watcher" "$workspace/src/kitchen_watcher"
cd "$workspace"
for target in "" install; do
  if ! catkin_make -DPYTHON_EXECUTABLE=/usr/bin/python3 $target; then
    echo "catkin_make $target failed"
    exit 1
  fi
done

result="both packages were built, and work in the devel space and in the install space"
for space in devel install; do
  said=$(set +u && . "$workspace/$space/setup.sh" && rosrun kitchen_watcher kitchen_watcher) || said=
  if [[ $said != *"a joint of type 1, "* ]]; then
    echo "$said"
    result="kitchen_watcher failed in the $space space"
    break
  fi
done
echo "$result"
[[ $result == both* ]]
