#!/usr/bin/env bash
# demo.sh [SCENE] [ROSLAUNCH ARGUMENTS]: installs what is missing, builds, runs a simulated scene through the whole
# pipeline, prints each learned object beside its ground truth, writes a picture, and exits with 0 when the models are
# right. SCENE is door, drawer, kitchen (the default) or pedestal. Examples: demo.sh drawer rviz:=true, demo.sh
# kitchen camera_motion:=true
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$(dirname "$here")/build

scene=kitchen
if [ $# -gt 0 ] && [[ $1 != *:=* ]]; then
  scene=$1
  shift
fi
case $scene in
  door | drawer | kitchen | pedestal) ;;
  *)
    echo "unknown scene '$scene', expected door, drawer, kitchen or pedestal" >&2
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

# A master of its own, so that the demo neither needs nor disturbs one that is running.
port=$(/usr/bin/python3 -c 'import socket; s = socket.socket(); s.bind(("", 0)); print(s.getsockname()[1])')
export ROS_MASTER_URI=http://localhost:$port ROS_HOSTNAME=localhost
picture=$build/demo_$scene.png
roslaunch -p "$port" cabinet_articulation demo.launch scene:="$scene" "$@" >"$build/demo_$scene.log" 2>&1 &
launch=$!
stop() {
  kill -INT "$launch" 2>/dev/null || true
  wait "$launch" 2>/dev/null || true
}
trap stop EXIT
until /usr/bin/python3 -c 'import rosgraph, sys; sys.exit(not rosgraph.is_master_online())'; do
  if ! kill -0 "$launch" 2>/dev/null; then
    cat "$build/demo_$scene.log"
    exit 1
  fi
  sleep 0.2
done

echo "watching the scene '$scene' (log: $build/demo_$scene.log)"
status=0
rosrun cabinet_articulation demo_report truth:="/$camera/truth" models:="/$namespace/models" \
  overlay:="/$namespace/overlay" _picture:="$picture" || status=$?
if [ $status -ne 0 ]; then grep -E 'WARN|ERROR|FATAL' "$build/demo_$scene.log" | tail -n 20 || true; fi
exit $status
