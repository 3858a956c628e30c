#!/usr/bin/env bash
# demo.sh [SCENE] [ROSLAUNCH ARGUMENTS]: installs what is missing, builds, runs a simulated scene through the whole
# pipeline, prints each learned object beside its ground truth, writes a picture, and exits with 0 when the models are
# right. SCENE is door, drawer, kitchen (the default), pedestal, bifold, trolley or cupboard. Examples: demo.sh drawer
# rviz:=true, demo.sh kitchen camera_motion:=true
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$(dirname "$here")/build

scene=kitchen
if [ $# -gt 0 ] && [[ $1 != *:=* ]]; then
  scene=$1
  shift
fi
case $scene in
  door | drawer | kitchen | pedestal | bifold | trolley | cupboard) ;;
  *)
    echo "unknown scene '$scene', expected door, drawer, kitchen, pedestal, bifold, trolley or cupboard" >&2
    exit 2
    ;;
esac
namespace=cabinet
camera=stereo
for argument in "$@"; do
  case $argument in
    ns:=*) namespace=${argument#ns:=} ;;
    camera:=*) camera=${argument#camera:=} ;;
  esac
done

export PATH=/usr/bin:$PATH
"$here/build.sh"
set +eu
. "$here/../devel/setup.sh"
set -eu

picture=$build/demo_$scene.png
. "$here/own_master.sh"
launch_with_own_master "$build/demo_$scene.log" demo.launch scene:="$scene" "$@"

echo "watching the scene '$scene' (log: $build/demo_$scene.log)"
status=0
rosrun cabinet_articulation demo_report truth:="/$camera/truth" models:="/$namespace/models" \
  overlay:="/$namespace/overlay" _picture:="$picture" || status=$?
if [ $status -ne 0 ]; then grep -E 'WARN|ERROR|FATAL' "$build/demo_$scene.log" | tail -n 20 || true; fi
exit $status
