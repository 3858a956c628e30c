#!/usr/bin/env bash
# measure_live.sh BAG [ARGUMENTS OF replay.launch]: plays a bag to the nodelets as fast as it was recorded. Prints how many frames
# were dropped, and the wall time from a frame's images to its models. The player shares the computer.
# Example, on two cores: simulated_bag kitchen kitchen.bag --rate 30; taskset -c 0,1 scripts/measure_live.sh kitchen.bag
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

if [ $# -eq 0 ] || [ ! -f "$1" ]; then
  echo "expected a bag, not '${1:-}'; usage: measure_live.sh BAG [ARGUMENTS OF replay.launch]" >&2
  exit 2
fi
bag=$(realpath "$1")
shift
camera=stereo ns=cabinet input=stereo left_info=left/camera_info depth_info=depth/camera_info
for argument in "$@"; do
  case $argument in
    camera:=*) camera=${argument#*:=} ;;
    ns:=*) ns=${argument#*:=} ;;
    input:=*) input=${argument#*:=} ;;
    left_info:=*) left_info=${argument#*:=} ;;
    depth_info:=*) depth_info=${argument#*:=} ;;
  esac
done
if [ "$input" = depth ]; then info=$depth_info; else info=$left_info; fi

export PATH=/usr/bin:$PATH
set +eu
. "$here/../devel/setup.sh"
set -eu
log=$(mktemp)
. "$here/own_master.sh"
launch_with_own_master "$log" replay.launch bag:="$bag" paused:=true "$@"
/usr/bin/python3 "$here/live_latency.py" "$camera/$info" "$ns" &
listener=$!
status=0
/usr/bin/python3 "$here/steer_replay.py" "$ns" || status=$?
kill "$listener" 2>/dev/null || true
wait "$listener" || status=$?
if [ $status -ne 0 ]; then
  echo "measure_live.sh: nothing was measured (log: $log)" >&2
  exit 1
fi
rm "$log"
